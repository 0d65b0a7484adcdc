#include "config/street_lamps.h"

#include <algorithm>
#include <numbers>

#include "config/base/paths.h"
#include "config/formats/toml_table.h"
#include "config/light_colour.h"

namespace phare {
namespace {

constexpr double kRadOfDeg = std::numbers::pi / 180.0;
constexpr double kFarthest_m = 1e7;  ///< beyond it a file is wrong

LuminaireConfig luminaire_of(TomlTable table, const std::filesystem::path& file) {
  LuminaireConfig luminaire;
  luminaire.name = table.text("name");
  luminaire.file = resolve_path(table.text("file"), file);
  luminaire.scale = table.number_or("scale", 1.0, 1e-6, 1e6);
  luminaire.c0_turn_deg = table.number_or("c0_deg", 0.0, -360.0, 360.0);
  luminaire.mirror = table.flag_or("mirror", false);
  luminaire.lamp_set = static_cast<std::size_t>(table.integer_or("lamp_set", 1, 1, 1000));
  luminaire.emitter = static_cast<std::size_t>(table.integer_or("emitter", 1, 1, 1000));
  const LightColour colour = read_light_colour(table);
  luminaire.colour_temperature_k = colour.colour_temperature_k.value_or(luminaire.colour_temperature_k);
  luminaire.chromaticity_xy = colour.chromaticity_xy;
  return luminaire;
}

}  // namespace

Result<StreetLampsConfig> read_street_lamps(const std::filesystem::path& file) {
  auto document = TomlTable::read(file);
  if (!document) return document.error();
  const std::filesystem::path whole = std::filesystem::absolute(file).lexically_normal();
  StreetLampsConfig config;
  config.file = whole;
  config.fineness =
      static_cast<Fineness>(document->choice_or("fineness", static_cast<std::size_t>(config.fineness), kFinenessNames));
  config.reflected = static_cast<Reflected>(
      document->choice_or("reflected", static_cast<std::size_t>(config.reflected), kReflectedNames));
  if (const std::string table = document->text_or("r_table", ""); !table.empty())
    config.r_table_file = resolve_path(table, whole);
  std::vector<std::string> names;
  for (TomlTable table : document->tables("luminaire")) {
    config.luminaires.push_back(luminaire_of(table, whole));
    if (std::ranges::count(names, config.luminaires.back().name) > 0)
      table.fail("name", "two luminaires are named \"" + config.luminaires.back().name + "\"");
    names.push_back(config.luminaires.back().name);
  }
  if (names.empty()) document->fail("luminaire", "expected [[luminaire]]");
  for (TomlTable table : document->tables("lamp")) {
    StreetLampConfig lamp;
    const std::string luminaire = table.text("luminaire");
    const auto found = std::ranges::find(names, luminaire);
    if (found == names.end() && !names.empty())
      table.fail("luminaire", unknown_name_reason("luminaire", luminaire, names));
    lamp.luminaire = static_cast<std::size_t>(found - names.begin());
    const std::vector<double> at = table.numbers("position_m", 3);
    if (at.size() == 3) lamp.position_m = {at[0], at[1], at[2]};
    if (!(std::max({std::abs(lamp.position_m.x), std::abs(lamp.position_m.y), std::abs(lamp.position_m.z)}) <
          kFarthest_m))
      table.fail("position_m", "is not within 10,000 km of the origin");
    lamp.yaw_rad = table.number_or("yaw_deg", 0.0, -360.0, 360.0) * kRadOfDeg;
    lamp.tilt_rad = table.number_or("tilt_deg", 0.0, -90.0, 90.0) * kRadOfDeg;
    if (table.flag_or("on", true))
      config.lamps.push_back(lamp);
    else
      ++config.off;
  }
  if (config.lamps.size() + config.off > kMostStreetLamps) document->fail("lamp", "more than 20000 lamps");
  if (const Status read = document->finish(); !read) return read.error();
  return config;
}

}  // namespace phare
