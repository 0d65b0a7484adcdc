#include "vehicle_dynamics/road_laid.h"

#include <cstdio>

#include "config/formats/csv_table.h"

namespace phare {
namespace {

Status lay_csv(const std::filesystem::path& file, double envelope_m, Road& road) {
  const Result<std::vector<FrictionZone>> zones = read_friction(file);
  if (!zones) return zones.error();
  road.friction.insert(road.friction.end(), zones->begin(), zones->end());
  const Result<CsvTable> table = CsvTable::read(file);
  if (!table) return table.error();
  const bool heights = table->find({"z_m", "z"}) || table->find({"z_left_m", "z_left"});
  if (!heights && !zones->empty()) return Done{};
  Result<HeightProfile> profile = HeightProfile::read(file);  // says what is missing where there is neither
  if (!profile) return profile.error();
  profile->smooth(envelope_m);
  road.profiles.push_back(std::move(*profile));
  return Done{};
}

}  // namespace

Status lay(const Conditions& c, const std::filesystem::path& scene_file, Road& road) {
  if (c.friction) road.friction_everywhere = *c.friction;
  if (const auto beside = friction_file_of(scene_file); !scene_file.empty() && std::filesystem::exists(beside)) {
    const Result<std::vector<FrictionZone>> zones = read_friction(beside);
    if (!zones) return zones.error();
    if (zones->empty()) return Error{beside.string(), "has no column friction, or friction_left and friction_right"};
    road.friction.insert(road.friction.end(), zones->begin(), zones->end());
  }
  if (!c.csv_file.empty())
    if (const Status laid = lay_csv(c.csv_file, c.envelope_m, road); !laid) return laid;
  if (!c.roughness.empty()) {
    const Result<RoughnessClass> roughness = parse_roughness(c.roughness, "--roughness");
    if (!roughness) return roughness.error();
    road.profiles.push_back(HeightProfile::iso8608(*roughness, c.seed));
  }
  return Done{};
}

std::string text(const Road& road) {
  std::string said;
  char part[80];
  const auto add = [&](const char* form, double number) {
    std::snprintf(part, sizeof part, form, number);
    said += (said.empty() ? "" : ", ") + std::string(part);
  };
  if (road.friction_everywhere != 1.0) add("friction %.3g", road.friction_everywhere);
  if (!road.friction.empty()) add("%.0f zones of friction", static_cast<double>(road.friction.size()));
  if (!road.profiles.empty())
    add(road.profiles.size() == 1 ? "a height profile" : "%.0f height profiles",
        static_cast<double>(road.profiles.size()));
  return said;
}

}  // namespace phare
