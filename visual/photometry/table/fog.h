// Light in fog: what of it arrives, and what is scattered into a line of sight. Float64: what faster ways of this
// program are measured against.
//
// Extinction from meteorological visibility (MOR, WMO: the distance after which 5 % of a parallel beam is left):
// σ = −ln 0.05/V = 2.9957/V. (Koschmieder's own constant, for 2 %, is 3.912.) Scattering once, from point lamps, as
// the distance law has it: L = Σ ∫ σ·ω·p(θ)·I/r²·exp(−σ(r + s)) ds along the line of sight. Fog is the same
// everywhere and for every colour. Left out: light that is scattered more than once (it adds 0.4 to 1.6 of that which
// is scattered once at visibilities of 200 to 50 m, by a Monte Carlo of ours), shadows in fog, the size of the lamp.
// Checked by tests/photometry/fog_test.cpp against quadratures of another program.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "visual/photometry/table/illuminance.h"

namespace phare {

/// What scatters. Nothing of `henyey_greenstein_g`: water droplets of 10 µm effective radius, from a table (see .cpp).
struct FogDroplets {
  std::optional<double> henyey_greenstein_g{};
  double albedo = 1.0;  ///< ω: of the light that is taken from a beam, the share that is scattered and not absorbed

  friend bool operator==(const FogDroplets&, const FogDroplets&) = default;
};

/// σ in 1/m of a meteorological visibility in m.
double extinction_per_m(double visibility_m);
/// Of light that goes `distance_m` through fog, the share that arrives: exp(−σ·d).
double transmittance(double extinction_per_m, double distance_m);

/// Share of the scattered light that leaves in a direction, 1/sr; over the whole sphere it is 1. `angle_rad` 0: goes
/// on as it came; pi: back to the lamp.
double phase_per_sr(const FogDroplets& droplets, double angle_rad);
/// The same by Henyey and Greenstein (1941); g is the mean cosine of the angle.
double henyey_greenstein_per_sr(double g, double angle_rad);

/// A line of sight that passes a lamp nearer than this counts as passing it there: lamps are no points.
inline constexpr double kNearestToLamp_m = 0.01;

/// The luminance in cd/m² that fog adds to a line of sight of `length_m` from `eye_m` along the unit `direction`.
/// Adaptive quadrature over the angle at the lamp; relative error below 1e-6, where candela are continuous.
double airlight_cdm2(std::span<const PlacedSource> sources, double extinction_per_m, const FogDroplets& droplets,
                     const glm::dvec3& eye_m, const glm::dvec3& direction, double length_m);

}  // namespace phare
