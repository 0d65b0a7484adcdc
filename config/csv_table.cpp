#include "config/csv_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string_view>

namespace phare {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

}  // namespace

Result<CsvTable> CsvTable::read(const std::filesystem::path& file) {
  CsvTable table;
  table.file_ = file.string();
  std::error_code problem;
  if (std::filesystem::is_directory(file, problem)) return Error{table.file_, "is a directory"};
  std::ifstream stream(file);
  if (!stream) return Error{table.file_, "cannot be read"};
  std::string line;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    const auto place = [&] { return table.file_ + ":" + std::to_string(number); };
    std::string_view rest = trimmed(line);
    if (number == 1 && rest.starts_with("\xef\xbb\xbf")) rest.remove_prefix(3);  // a byte order mark of a spreadsheet
    if (rest.empty() || rest.front() == '#') continue;
    const bool header = table.columns_.empty();
    for (std::size_t column = 0;; ++column) {
      const std::size_t comma = rest.find(',');
      const std::string_view cell = trimmed(rest.substr(0, comma));
      if (header) {
        if (column >= 4096) return Error{place(), "more than 4096 columns"};
        if (std::find(table.columns_.begin(), table.columns_.end(), cell) != table.columns_.end())
          return Error{place(), "column \"" + std::string(cell) + "\" comes twice"};
        table.columns_.emplace_back(cell);
      } else {
        if (column >= table.columns_.size())
          return Error{place(), "more cells than the header's " + std::to_string(table.columns_.size())};
        double value = 0.0;
        const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
        if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value))
          return Error{place(), "column " + table.columns_[column] + ": \"" + std::string(cell.substr(0, 40)) +
                                    "\" is not a finite number"};
        table.cells_.push_back(value);
      }
      if (comma == std::string_view::npos) {
        if (!header && column + 1 < table.columns_.size())
          return Error{place(), "column " + table.columns_[column + 1] + " is missing"};
        break;
      }
      rest.remove_prefix(comma + 1);
    }
    if (!header) table.lines_.push_back(number);
  }
  if (table.columns_.empty()) return Error{table.file_, "has no header line"};
  return table;
}

std::optional<std::size_t> CsvTable::find(std::initializer_list<const char*> names) const {
  for (const char* name : names) {
    const auto found = std::find(columns_.begin(), columns_.end(), name);
    if (found != columns_.end()) return static_cast<std::size_t>(found - columns_.begin());
  }
  return std::nullopt;
}

std::string CsvTable::place(std::size_t row) const {
  return row < lines_.size() ? file_ + ":" + std::to_string(lines_[row]) : file_;
}

}  // namespace phare
