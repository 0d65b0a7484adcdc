// What lies in the air between a lamp, what it lights, and the eye: fog by its visibility, rain and snow by their
// rates. All take light from every beam alike, and each sends it where it does (fog.h, precipitation.h).
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>

#include "visual/photometry/table/fog.h"
#include "visual/photometry/table/precipitation.h"

namespace phare {

struct Air {
  std::optional<double> visibility_m{};  ///< meteorological optical range; nothing: no fog
  FogDroplets droplets{};                ///< what the fog is made of
  double rain_mmph = 0.0;                ///< 0 to 100
  double snow_mmph = 0.0;                ///< of water, 0 to 10

  bool clear() const { return !visibility_m && !falls(); }
  bool falls() const { return rain_mmph > 0.0 || snow_mmph > 0.0; }
  /// What is drawn one by one: the more of the two, as snow among rain melts. Only where something falls.
  Particles particles() const;

  friend bool operator==(const Air&, const Air&) = default;
};

/// "clear air", or "visibility 80 m, rain 5 mm/h".
std::string words_of(const Air& air);

/// 1/m, of all that is in it.
double extinction_per_m(const Air& air);
/// Of it what is scattered and not absorbed.
double scattering_per_m(const Air& air);
/// Share of what all scatter that leaves in a direction, 1/sr, as phase_per_sr() of fog. 0 in clear air.
double phase_per_sr(const Air& air, double angle_rad);
/// The part of it that Air::particles() scatter.
double phase_of_particles_per_sr(const Air& air, double angle_rad);

/// As that of fog, of all that is in the air.
double airlight_cdm2(std::span<const PlacedSource> sources, const Air& air, const glm::dvec3& eye_m,
                     const glm::dvec3& direction, double length_m);

}  // namespace phare
