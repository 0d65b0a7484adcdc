#include "config/formats/csv_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <streambuf>
#include <string_view>
#include <utility>

namespace phare {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

constexpr std::uint64_t kMostBytes = 2ull << 30;
constexpr std::size_t kMostColumns = 4096, kMostCells = 50'000'000, kMostInLine = 1 << 20;

// The next line without its end; false: there is none. Stops behind kMostInLine, so a stream without line ends ends.
bool next_line(std::streambuf& from, std::string& line) {
  using Traits = std::streambuf::traits_type;
  line.clear();
  auto c = from.sbumpc();
  if (Traits::eq_int_type(c, Traits::eof())) return false;
  while (!Traits::eq_int_type(c, Traits::eof()) && c != '\n' && line.size() <= kMostInLine) {
    line.push_back(Traits::to_char_type(c));
    c = from.sbumpc();
  }
  return true;
}

// Why a text is no number that a cell may hold; nullptr: it is one.
const char* refused(std::string_view cell, double& value) {
  if (cell.size() > 1 && cell[0] == '+' && cell[1] != '-') cell.remove_prefix(1);
  const char* const all = cell.data() + cell.size();
  const auto [end, error] = std::from_chars(cell.data(), all, value);
  if (error == std::errc::result_out_of_range && end == all) {
    value = std::strtod(std::string(cell).c_str(), nullptr);  // too small is 0, or as near to it as numbers are
    return std::abs(value) < 1.0 ? nullptr : "is too large for a number";
  }
  return error == std::errc() && end == all && std::isfinite(value) ? nullptr : "is not a finite number";
}

}  // namespace

Result<CsvTable> CsvTable::read(const std::filesystem::path& file) {
  CsvTable table;
  table.file_ = file.string();
  std::error_code problem;
  const std::filesystem::file_status kind = std::filesystem::status(file, problem);
  if (std::filesystem::is_directory(kind)) return Error{table.file_, "is a directory"};
  if (std::filesystem::exists(kind) && !std::filesystem::is_regular_file(kind) && !std::filesystem::is_fifo(kind))
    return Error{table.file_, "is a device, neither a file nor a pipe"};
  constexpr const char* kTooMuch = "is larger than 2 GiB";
  if (std::filesystem::is_regular_file(kind) && std::filesystem::file_size(file, problem) > kMostBytes && !problem)
    return Error{table.file_, kTooMuch};
  std::ifstream stream(file);
  if (!stream) return Error{table.file_, "cannot be read"};
  std::string line;
  std::uint64_t bytes = 0;
  for (std::size_t number = 1; next_line(*stream.rdbuf(), line); ++number) {
    const auto place = [&] { return table.file_ + ":" + std::to_string(number); };
    if (line.size() > kMostInLine) return Error{place(), "is longer than 1 MiB"};
    if ((bytes += line.size() + 1) > kMostBytes + 1) return Error{place(), kTooMuch};
    std::string_view rest = trimmed(line);
    if (number == 1 && rest.starts_with("\xef\xbb\xbf")) rest.remove_prefix(3);  // a byte order mark of a spreadsheet
    if (number == 1 && (rest.starts_with("\xff\xfe") || rest.starts_with("\xfe\xff")))
      return Error{place(), "is UTF-16; plain text or UTF-8 is wanted"};
    if (rest.find('\r') != std::string_view::npos)
      return Error{place(), "has carriage returns within; a line ends with a line feed"};
    if (rest.empty() || rest.front() == '#') continue;
    const bool header = table.columns_.empty();
    if (header) table.header_line_ = number;
    if (header && rest.find(',') == std::string_view::npos)
      for (const auto& [separator, name] : {std::pair{';', "\";\""}, {'\t', "tabulators"}})
        if (rest.find(separator) != std::string_view::npos)
          return Error{place(), std::string("the header line separates its columns by ") + name +
                                    "; a comma is wanted, and a point in numbers"};
    for (std::size_t column = 0;; ++column) {
      const std::size_t comma = rest.find(',');
      const std::string_view cell = trimmed(rest.substr(0, comma));
      if (header) {
        if (column >= kMostColumns) return Error{place(), "more than 4096 columns"};
        if (std::find(table.columns_.begin(), table.columns_.end(), cell) != table.columns_.end())
          return Error{place(), "column \"" + std::string(cell.substr(0, 40)) + "\" comes twice"};
        table.columns_.emplace_back(cell);
      } else {
        if (column >= table.columns_.size())
          return Error{place(), "more cells than the header's " + std::to_string(table.columns_.size())};
        double value = 0.0;
        if (const char* reason = refused(cell, value))
          return Error{place(),
                       "column " + table.columns_[column] + ": \"" + std::string(cell.substr(0, 40)) + "\" " + reason};
        if (table.cells_.size() >= kMostCells) return Error{place(), "more than 50 million cells"};
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
