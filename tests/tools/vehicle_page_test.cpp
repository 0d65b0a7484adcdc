// unit: docs/vehicle-file.md against the reader: every key, whether it is required, and its range.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "config/vehicle.h"
#include "tests/paths.h"

namespace phare {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

struct PageKey {
  std::string key, range, fallback;
};
std::vector<PageKey> keys_of_page() {
  std::vector<PageKey> keys;
  std::ifstream stream(source_dir() + "/docs/vehicle-file.md");
  const std::regex row("^\\| `([a-z0-9_.]+)` \\| [^|]* \\| ([^|]*) \\| ([^|]*) \\|.*");
  for (std::string line; std::getline(stream, line);) {
    std::smatch cells;
    if (std::regex_match(line, cells, row)) keys.push_back({cells[1], cells[2], cells[3]});
  }
  return keys;
}

/// A vehicle file's lines with the full name of the key that each sets; empty: none.
struct Line {
  std::string text, key;
};
std::vector<Line> lines_of(const std::string& text) {
  std::vector<Line> lines;
  std::istringstream stream(text);
  std::string table;
  const std::regex heading("^\\[([a-z]+)\\].*"), setting("^([a-z0-9_]+) *=.*");
  for (std::string line; std::getline(stream, line);) {
    std::smatch found;
    std::string key;
    if (std::regex_match(line, found, heading))
      table = found[1].str() + ".";
    else if (std::regex_match(line, found, setting))
      key = table + found[1].str();
    lines.push_back({line, key});
  }
  return lines;
}

/// What the reader says of the hatchback with one key set otherwise, or left out.
std::string refusal(const std::string& key, const std::optional<std::string>& value) {
  const std::vector<Line> lines = lines_of(text_of(source_dir() + "/config/vehicles/hatchback.toml"));
  const std::size_t dot = key.rfind('.') + 1;
  const std::string setting = value ? key.substr(dot) + " = " + *value + "\n" : "";
  const bool there = std::ranges::find(lines, key, &Line::key) != lines.end();
  const std::string heading = "[" + key.substr(0, std::max<std::size_t>(dot, 1) - 1) + "]";
  std::string text;
  for (const Line& line : lines) {
    text += line.key == key ? setting : line.text + "\n";
    if (!there && line.text.starts_with(heading)) text += setting;
  }
  const auto read = parse_vehicle(text, "car.toml");
  return read ? "" : read.error().text();
}

TEST(VehiclePage, NamesEveryKeyOfTheShippedCars) {
  std::set<std::string> page, shipped;
  for (const PageKey& key : keys_of_page()) EXPECT_TRUE(page.insert(key.key).second) << key.key << " stands twice";
  for (const auto& file : fs::directory_iterator(source_dir() + "/config/vehicles"))
    for (const Line& line : lines_of(text_of(file.path())))
      if (!line.key.empty()) shipped.insert(line.key);
  for (const char* left_out : {"drive.creep_n", "drive.creep_kmh", "drive.hill_hold_s"}) shipped.insert(left_out);
  EXPECT_EQ(page, shipped);
}

TEST(VehiclePage, RangesAndWhatIsRequiredAreTheReaders) {
  for (const PageKey& key : keys_of_page()) {
    const bool list = key.key == "engine.speed_rpm" || key.key == "engine.torque_nm" || key.key == "engine.gear_ratio";
    const std::string quoted = "\"" + key.key + "\"";
    const bool required = key.fallback == "required" || key.fallback == "with [body]";
    const std::string without = refusal(key.key, std::nullopt);
    if (key.fallback != "with that mass") {
      EXPECT_EQ(without.find(quoted) != std::string::npos, required) << key.key << ": " << without;
    }
    const std::size_t to = key.range.find(" to ");
    if (to == std::string::npos || list) continue;
    const double low = std::stod(key.range.substr(0, to)), high = std::stod(key.range.substr(to + 4));
    for (const double beyond : {low - 1e-3 * (std::abs(low) + 1.0), high + 1e-3 * (std::abs(high) + 1.0)}) {
      const std::string said = refusal(key.key, std::to_string(beyond));
      EXPECT_NE(said.find(quoted), std::string::npos) << key.key << " = " << beyond << ": " << said;
      EXPECT_NE(said.find("outside"), std::string::npos) << key.key << " = " << beyond << ": " << said;
    }
  }
}

}  // namespace
}  // namespace phare
