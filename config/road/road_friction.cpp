#include "config/road/road_friction.h"

#include <string>

#include "config/formats/csv_table.h"

namespace phare {

Result<std::vector<FrictionZone>> read_friction(const std::filesystem::path& csv_file) {
  constexpr std::size_t kMostZones = 64;  // they are looked through several times a step
  constexpr double kForGood_m = 1e12;
  Result<CsvTable> table = CsvTable::read(csv_file);
  if (!table) return table.error();
  const auto x = table->find({"x_m", "x", "s_m"}), both = table->find({"friction"});
  const auto left = both ? both : table->find({"friction_left"}), right = both ? both : table->find({"friction_right"});
  std::vector<FrictionZone> zones;
  if (!left && !right) return zones;
  const std::string header = csv_file.string() + ":" + std::to_string(table->header_line());
  if (!x) return Error{header, "has no column x_m: where the friction begins"};
  if (!left || !right)
    return Error{header, "friction of one track only: give friction_left and friction_right, or friction"};
  for (std::size_t row = 0; row < table->rows(); ++row) {
    const double from = table->at(row, *x);
    const FrictionZone zone{from, kForGood_m, table->at(row, *left), table->at(row, *right)};
    for (const double friction : {zone.left, zone.right})
      if (!(friction >= kLeastFriction && friction <= kMostFriction))
        return Error{table->place(row), "friction " + std::to_string(friction) + " is outside 0.01 to 2"};
    if (row > 0 && !(from > table->at(row - 1, *x))) return Error{table->place(row), "x_m does not rise"};
    if (!zones.empty() && zones.back().left == zone.left && zones.back().right == zone.right) continue;
    if (!zones.empty()) zones.back().to_m = from;
    if (zones.size() == kMostZones) return Error{table->place(row), "friction changes more than 64 times"};
    zones.push_back(zone);
  }
  return zones;
}

std::filesystem::path friction_file_of(const std::filesystem::path& scene_file) {
  return scene_file.parent_path() / (scene_file.stem().string() + "_friction.csv");
}

}  // namespace phare
