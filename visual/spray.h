// Spray that vehicles throw up from a wet road, as a view draws it. Pure: no device.
//
// Model: tyres pick up the water in their way, width times depth; a share of it leaves as fine drops and hangs in the
// air behind the wheels. The cloud is what its puffs are (shaders/spray.h): one after the other, by turns of the left
// and the right wheels, each standing where it was thrown up, growing and settling. Places and sizes follow from its
// number and the time, so a drive in lockstep is the same to the bit. A puff takes and scatters light as rain does, by
// the area of its drops: 1.5 of the volume over the diameter, diffraction left out
// (photometry/table/precipitation.h).
// Unconfirmed, chosen, all of it: shares, sizes, times, widths, below. What they come to, 0.01 kg/m3 behind a car at
// 100 km/h in rain of 25 mm/h, is of the order of the 0.005 to 0.03 kg/m3 by which an assessment tool of the FHWA
// grades splash and spray at that rate (seen on a slide of it alone).
// Left out: splash to the sides, wind, what the cloud hides of a lamp from itself and from the ground, light that is
// scattered twice, the spray of the own car, and what wraps the eye (to 6 m all, from 12 m on nothing).
// Checked by tests/visual/spray_test.cpp.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shaders/spray.h"
#include "visual/view.h"

namespace phare {

/// Below, tyres drip and throw up nothing fine.
inline constexpr double kSprayFrom_mps = 30.0 / 3.6;
/// Vehicles farther from the eye are left out, and more than these, the farthest first.
inline constexpr double kSprayTo_m = 150.0;
inline constexpr std::size_t kMostSpraying = 4;
/// After so long a puff has lost 63 % of its drops: those of 0.2 mm fall at 0.8 m/s.
inline constexpr double kSprayLife_s = 0.8;
inline constexpr double kSprayAge_s = kSprayLife_s * shader::kSprayLives;  ///< of the oldest puff
inline constexpr double kSprayDrop_mm = 0.2;
inline constexpr double kSprayPuff_m = 0.7, kSprayGrows_mps = 0.8;  ///< radius as it is thrown up
inline constexpr double kSprayG = 0.70;                             ///< Henyey and Greenstein's, as of rain

/// Red of signal lamps, linear sRGB of luminance 1. Chosen by eye: no display has the red that UN R148 asks for.
inline const glm::vec3 kSignalRed = glm::vec3(1.0f, 0.02f, 0.01f) / (0.2126f + 0.7152f * 0.02f + 0.0722f * 0.01f);

/// A vehicle that is fast enough to throw up water.
struct SprayingVehicle {
  /// Between its rear wheels on the road: now, half of kSprayAge_s ago, and all of it.
  std::array<glm::dvec3, 3> wheels_m{};
  glm::dvec3 left{0.0, 1.0, 0.0};
  double half_track_m = 0.75;
  double tyres_m = 0.4;  ///< width of what its tyres roll over
  double speed_mps = 0.0;
  std::array<glm::dvec3, 2> tail_m{};  ///< its tail lamps
  double tail_cd = 0.0;                ///< of each straight behind, with a brake lamp that burns beside it
  glm::vec3 tail_colour = kSignalRed;  ///< of both together, linear sRGB, luminance 1
  double time_s = 0.0;
  std::uint32_t number = 0;  ///< that its puffs differ from those of others
};

/// Of the water in the way of its tyres what leaves as fine drops: 5 % at 100 km/h, with the square of what it is
/// faster than kSprayFrom_mps, a tenth at most.
double spray_share_01(double speed_mps);

/// Of a metre of the way what its drops scatter, m2.
double spray_scatters_m2_per_m(const SprayingVehicle& vehicle, double water_mm);

/// The nearest ones whose cloud the view may see, farthest first.
std::vector<SprayingVehicle> spraying_seen(const ViewGeometry& view, std::span<const SprayingVehicle> vehicles);

/// The cloud of one for its draw; `water_mm`: visual/ground_water.h.
shader::GpuSpray spray_of(const SprayingVehicle& vehicle, double water_mm, const glm::dvec3& eye_m);

}  // namespace phare
