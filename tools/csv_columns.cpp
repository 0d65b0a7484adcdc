#include "tools/csv_columns.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string_view>

#include "config/base/input_files.h"
#include "config/formats/toml_table.h"

namespace phare {
namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t start = 0; start <= line.size();) {
    const std::size_t end = std::min(line.find(',', start), line.size());
    cells.push_back(trimmed(line.substr(start, end - start)));
    start = end + 1;
  }
  return cells;
}

}  // namespace

Result<std::vector<std::vector<double>>> read_csv_columns(const std::filesystem::path& file,
                                                          std::span<const std::string> names) {
  if (const std::string why = why_no_file(file); !why.empty()) return Error{file.string(), why};
  std::ifstream stream(file);
  if (!stream) return Error{file.string(), "cannot be read"};
  std::vector<std::vector<double>> columns(names.size());
  std::vector<std::size_t> places;
  std::string line;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    const std::string_view text = trimmed(line);
    if (text.empty() || text.front() == '#') continue;
    const std::string place = file.string() + ":" + std::to_string(number);
    const std::vector<std::string_view> cells = cells_of(text);
    if (places.empty()) {
      const std::vector<std::string> header(cells.begin(), cells.end());
      for (const std::string& name : names) {
        const auto found = std::find(header.begin(), header.end(), name);
        if (found == header.end()) {
          const std::string nearest = nearest_name(name, header);
          return Error{place, "no column \"" + name + "\"" + (nearest.empty() ? "" : "; there is \"" + nearest + "\"")};
        }
        places.push_back(static_cast<std::size_t>(found - header.begin()));
      }
      continue;
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (places[i] >= cells.size()) return Error{place, "no value for \"" + names[i] + "\""};
      const std::string_view cell = cells[places[i]];
      double value = 0.0;
      const auto [stop, failed] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
      if (failed != std::errc() || stop != cell.data() + cell.size() || !std::isfinite(value)) {
        return Error{place, "\"" + names[i] + "\": expected a finite number, got \"" + std::string(cell) + "\""};
      }
      columns[i].push_back(value);
    }
  }
  if (places.empty()) return Error{file.string(), "is empty"};
  if (columns.empty() || columns.front().empty()) return Error{file.string(), "has no line of numbers"};
  return columns;
}

}  // namespace phare
