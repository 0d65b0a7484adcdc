// Small helpers of the photometry tests: temporary files, CSV tables, the reference data set.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace phare::test {

/// Writes `text` to a file of its own for the running test.
inline std::filesystem::path temporary_file(const std::string& name, const std::string& text) {
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / ("phare_photometry_" + std::to_string(::getpid()) + "_" + info->name());
  std::filesystem::create_directories(folder);
  std::ofstream(folder / name, std::ios::binary) << text;
  return folder / name;
}

inline std::string content_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::stringstream content;
  content << stream.rdbuf();
  return content.str();
}

/// A CSV file by column name.
struct Csv {
  std::map<std::string, std::size_t> column;
  std::vector<std::vector<std::string>> rows;

  static std::vector<std::string> split(std::string line) {
    if (line.ends_with('\r')) line.pop_back();
    std::vector<std::string> fields;
    std::stringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
    if (line.ends_with(',')) fields.emplace_back();
    return fields;
  }

  explicit Csv(const std::filesystem::path& path) {
    std::ifstream stream(path);
    std::string line;
    std::getline(stream, line);
    for (const std::string& name : split(line)) column.emplace(name, column.size());
    while (std::getline(stream, line)) rows.push_back(split(line));
  }

  bool has(const std::string& name) const { return column.contains(name); }
  const std::string& text(std::size_t row, const std::string& name) const { return rows[row].at(column.at(name)); }
  double number(std::size_t row, const std::string& name) const { return std::strtod(text(row, name).c_str(), nullptr); }
};

inline std::filesystem::path shared_data(const std::string& below) { return std::filesystem::path(PHARE_SHARED_DATA_DIR) / below; }

}  // namespace phare::test

/// Tests against data that is not part of the repository say so where it is missing.
#define PHARE_NEEDS_SHARED_DATA(below)                                                            \
  if (!std::filesystem::exists(phare::test::shared_data(below)))                                  \
  GTEST_SKIP() << "reference data " << phare::test::shared_data(below).string() << " is not here"
