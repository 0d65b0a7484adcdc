// A table of comma-separated values with names in its first line, as the reference data are.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace phare::test {

struct CsvTable {
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> rows;

  /// As many as there are names: no such column.
  std::size_t column(const std::string& name) const {
    return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
  }
  const std::string& text(std::size_t row, const std::string& name) const { return rows[row].at(column(name)); }
  double number(std::size_t row, const std::string& name) const { return std::stod(text(row, name)); }
};

inline CsvTable read_csv_table(const std::filesystem::path& file) {
  CsvTable table;
  std::ifstream in(file);
  std::string line, cell;
  std::getline(in, line);
  for (std::istringstream cells(line); std::getline(cells, cell, ',');) table.names.push_back(cell);
  while (std::getline(in, line)) {
    table.rows.emplace_back();
    for (std::istringstream cells(line); std::getline(cells, cell, ',');) table.rows.back().push_back(cell);
  }
  return table;
}

}  // namespace phare::test
