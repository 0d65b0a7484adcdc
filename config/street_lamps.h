// Street lamps of a scene: reader of their TOML file. Kinds of luminaire with a photometry file each, and where each
// lamp stands. Light is computed elsewhere (visual/fixed_light.h); this knows no photometry. Every key stands in
// docs/street-lamps.md. Checked by tests/visual_process/street_lamps_test.cpp.
#pragma once

#include <array>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/base/result.h"

namespace phare {

struct LuminaireConfig {
  std::string name;
  std::filesystem::path file;  ///< type C, gamma 0 its axis; resolved
  double scale = 1.0;          ///< multiplies candela: dimming, maintenance factor
  double c0_turn_deg = 0.0;    ///< 0: plane C 0 lies on the right of who looks to the street side; 90: on that side
  bool mirror = false;         ///< the file is clockwise or mirrored: turn left and right round
  std::size_t lamp_set = 1, emitter = 1;  ///< EULUMDAT, TM-33: which of the file's, from 1
  double colour_temperature_k = 4000.0;
  std::optional<glm::dvec2> chromaticity_xy{};  ///< CIE 1931; in place of the colour temperature
};

/// The luminaire's axis (gamma 0) looks down, its plane C 90 toward `yaw_rad`: the street side of a road luminaire.
struct StreetLampConfig {
  std::size_t luminaire = 0;   ///< which of the file's
  glm::dvec3 position_m{0.0};  ///< of its light's centre, in the world
  double yaw_rad = 0.0;        ///< from x toward y
  double tilt_rad = 0.0;       ///< of its axis, up toward the street side
};

/// How finely the light is baked into the scene (visual/fixed_light.h).
enum class Fineness { kCoarse, kMedium, kFine };
inline constexpr std::array<std::string_view, 3> kFinenessNames{"coarse", "medium", "fine"};

/// How often light is taken on from surface to surface where the sky does not reach (visual/reflected_light.h).
enum class Reflected { kOff, kOnce, kAll };
inline constexpr std::array<std::string_view, 3> kReflectedNames{"off", "once", "all"};

struct StreetLampsConfig {
  std::filesystem::path file;
  Fineness fineness = Fineness::kMedium;
  Reflected reflected = Reflected::kAll;
  std::filesystem::path r_table_file{};  ///< of asphalt (visual/fixed_light.h), resolved; empty: none
  std::vector<LuminaireConfig> luminaires;
  std::vector<StreetLampConfig> lamps;  ///< those that are switched on
  std::size_t off = 0;                  ///< lamps that are not
};

/// So many of a file are read; more is taken for an error.
inline constexpr std::size_t kMostStreetLamps = 20000;

/// Errors with file:line and reason. Spectra are read, the photometry files are not opened.
Result<StreetLampsConfig> read_street_lamps(const std::filesystem::path& file);

}  // namespace phare
