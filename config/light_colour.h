// The colour of a light as config files name it, one of three: colour_temperature_k, chromaticity_xy, or a spectrum in
// a file of its own. Sources of a rig, luminaires of street lamps and lamps of other road users all read it here.
// Checked by tests/tools/rig_test.cpp, tests/traffic/road_users_test.cpp.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>

namespace phare {

class TomlTable;

struct LightColour {
  std::optional<double> colour_temperature_k{};
  std::optional<glm::dvec2> chromaticity_xy{};  ///< CIE 1931; given, or of the spectrum
  std::filesystem::path spectrum{};             ///< what chromaticity_xy is of, resolved; empty: none

  bool said() const { return colour_temperature_k || chromaticity_xy; }
  bool operator==(const LightColour&) const = default;
};

/// Nothing is said where the table has none of the keys. What is wrong is noted at its key.
LightColour read_light_colour(TomlTable& table);

}  // namespace phare
