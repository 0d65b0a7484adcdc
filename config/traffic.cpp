#include "config/traffic.h"

#include "config/formats/toml_table.h"

namespace phare {
namespace {

constexpr std::array<std::string_view, 3> kDirections{"oncoming", "standing", "same"};

/// Width, height, length in m: usual sizes, chosen by eye; those of SIZES_M in road_users.py.
constexpr std::array<std::array<double, 3>, kRoadUserNames.size()> kSizes_m{
    {{1.8, 1.5, 4.3}, {2.5, 3.6, 10.0}, {0.8, 1.4, 2.1}, {0.6, 1.7, 1.8}, {0.5, 1.75, 0.4}}};

RoadUser read_road_user(TomlTable& table) {
  RoadUser user;
  user.kind = static_cast<RoadUserKind>(table.choice_or("class", 0, kRoadUserNames));
  user.direction = static_cast<int>(table.choice_or("direction", 0, kDirections)) - 1;
  user.start_s_m = table.number_or("start_s_m", 0.0, -1e6, 1e6);
  user.speed_mps = table.number_or("speed_kmh", 0.0, 0.0, 500.0) / 3.6;
  user.offset_m = table.number_or("offset_m", 0.0, -1000.0, 1000.0);
  user.lights = table.flag_or("lights", true) && user.kind != RoadUserKind::kPedestrian;
  user.from_s = table.number_or("from_s", 0.0, -1e9, 1e9);
  if (table.has("to_s")) user.to_s = table.number("to_s", -1e9, 1e9);
  const auto& [width_m, height_m, length_m] = kSizes_m[static_cast<std::size_t>(user.kind)];
  user.width_m = table.number_or("width_m", width_m, 0.01, 100.0);
  user.height_m = table.number_or("height_m", height_m, 0.01, 100.0);
  user.length_m = table.number_or("length_m", length_m, 0.01, 100.0);
  return user;
}

}  // namespace

Result<std::vector<RoadUser>> read_traffic(const std::filesystem::path& file) {
  auto root = TomlTable::read(file);
  if (!root) return root.error();
  std::vector<RoadUser> users;
  for (TomlTable table : root->tables("road_user")) users.push_back(read_road_user(table));
  if (users.empty()) root->fail("road_user", "expected at least one [[road_user]]");
  if (const Status done = root->finish(); !done) return done.error();
  return users;
}

}  // namespace phare
