// A CSV file of numbers with a header line, every cell checked. Errors say file:line and column.
#pragma once

#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "config/base/result.h"

namespace phare {

/// Comma separated, one header line, every cell a finite number, every row as long as the header. Lines that are empty
/// or begin with # are passed over. A file or a pipe, no device; at most 2 GiB, 4096 columns, 50 million cells and 1
/// MiB in a line, so that no file takes all memory.
class CsvTable {
 public:
  static Result<CsvTable> read(const std::filesystem::path& file);

  std::size_t rows() const { return columns_.empty() ? 0 : cells_.size() / columns_.size(); }
  const std::vector<std::string>& columns() const { return columns_; }
  /// The first of these names that is a column.
  std::optional<std::size_t> find(std::initializer_list<const char*> names) const;
  double at(std::size_t row, std::size_t column) const { return cells_[row * columns_.size() + column]; }
  /// "file:line" of a row, and the line alone.
  std::string place(std::size_t row) const;
  std::size_t line(std::size_t row) const { return lines_[row]; }
  std::size_t header_line() const { return header_line_; }

 private:
  std::string file_;
  std::vector<std::string> columns_;
  std::vector<double> cells_;
  std::vector<std::size_t> lines_;
  std::size_t header_line_ = 1;
};

}  // namespace phare
