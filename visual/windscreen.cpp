#include "visual/windscreen.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "visual/photometry/table/precipitation.h"

namespace phare {
namespace {

constexpr double kSpread = 2.0;
constexpr double kSlant_rad = 30.0 * std::numbers::pi / 180.0;  // of the glass over the ground
constexpr double kLeast_mm = 0.5;  // smaller ones go round the car with the air: chosen

}  // namespace

double covered_per_s(const Air& air, double speed_mps) {
  if (air.rain_mmph <= 0.0) return 0.0;
  const Particles rain = particles_of(Precipitation::kRain, air.rain_mmph);
  const double beyond_mm = 1.0 / rain.slope_per_mm;  // mean of what is more than the least
  const double mean_square_mm2 = kLeast_mm * kLeast_mm + 2.0 * kLeast_mm * beyond_mm + 2.0 * beyond_mm * beyond_mm;
  const double meets_mps = std::max(speed_mps, 0.0) * std::sin(kSlant_rad) +
                           fall_mps(Precipitation::kRain, kLeast_mm + beyond_mm) * std::cos(kSlant_rad);
  const double area_m2 = 0.25 * std::numbers::pi * kSpread * kSpread * mean_square_mm2 * 1e-6;
  return rain.number_per_m3(kLeast_mm) * meets_mps * area_m2;
}

WiperPace pace_of(Wiper wiper) {
  constexpr double kStroke_s = 0.45;
  constexpr std::array<WiperPace, 4> kPaces{{{}, {6.0, kStroke_s}, {60.0 / 45.0, kStroke_s}, {60.0 / 65.0, kStroke_s}}};
  return kPaces[static_cast<std::size_t>(wiper)];
}

}  // namespace phare
