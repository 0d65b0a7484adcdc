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

#include "tests/paths.h"

namespace phare::test {

/// A folder for the files of this run; gone at its end.
class TemporaryFolder {
 public:
  TemporaryFolder()
      : path_(std::filesystem::path(::testing::TempDir()) / ("phare_photometry_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Writes `text` to a file, replacing one of that name.
inline std::filesystem::path temporary_file(const std::string& name, const std::string& text) {
  static const TemporaryFolder folder;
  std::ofstream(folder.path() / name, std::ios::binary) << text;
  return folder.path() / name;
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
  double number(std::size_t row, const std::string& name) const {
    return std::strtod(text(row, name).c_str(), nullptr);
  }
};

inline std::filesystem::path shared_data(const std::string& below) {
  return std::filesystem::path(shared_data_dir()) / below;
}

}  // namespace phare::test

/// Tests against data that is not part of the repository say so where it is missing.
#define PHARE_NEEDS_SHARED_DATA(below)                           \
  if (!std::filesystem::exists(phare::test::shared_data(below))) \
  GTEST_SKIP() << "reference data " << phare::test::shared_data(below).string() << " is not here"
