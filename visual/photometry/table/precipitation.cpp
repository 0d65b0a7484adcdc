#include "visual/photometry/table/precipitation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace phare {
namespace {

/// Edges of the cubes. Chosen: a drop of 2 mm is a pixel wide at 2 m, and half of what rain scatters in a beam it
/// scatters within the first metres of it.
constexpr std::array<double, kDropClasses> kCubes_m{4.0, 8.0, 16.0};
/// The fit of Atlas et al. is for drops from here.
constexpr double kLeastFitted_mm = 0.5;
constexpr double kPerKilometre = 1e-3;
/// Of extinction with Q = 2, what is not diffraction.
constexpr double kMet = 0.5;

}  // namespace

double Particles::number_per_m3(double diameter_mm) const {
  return n0_per_m3mm / slope_per_mm * std::exp(-slope_per_mm * diameter_mm);
}

double Particles::share_of_larger(double diameter_mm) const {
  if (std::isinf(diameter_mm)) return 0.0;
  const double x = slope_per_mm * diameter_mm;  // the integral of D²·exp(−slope·D)
  return std::exp(-x) * (1.0 + x + 0.5 * x * x);
}

Particles particles_of(Precipitation kind, double rate_mmph) {
  Particles p{.kind = kind};
  if (kind == Precipitation::kRain) {
    p.n0_per_m3mm = 8000.0;
    p.slope_per_mm = 4.1 * std::pow(rate_mmph, -0.21);
    p.scattering_per_m = kMet * 0.365 * std::pow(rate_mmph, 0.63) * kPerKilometre;
    p.g = 0.70;
  } else {
    p.n0_per_m3mm = 3800.0 * std::pow(rate_mmph, -0.87);
    p.slope_per_mm = 2.55 * std::pow(rate_mmph, -0.48);
    p.scattering_per_m = kMet * 4.92 * rate_mmph * kPerKilometre;
    p.g = 0.0;
  }
  const double discs_per_m =
      0.25 * std::numbers::pi * p.n0_per_m3mm * 2.0 / (p.slope_per_mm * p.slope_per_mm * p.slope_per_mm) * 1e-6;
  p.area_factor = p.scattering_per_m / discs_per_m;
  return p;
}

double fall_mps(Precipitation kind, double diameter_mm) {
  if (kind == Precipitation::kSnow) return 1.0;
  const auto fitted = [](double mm) { return 9.65 - 10.3 * std::exp(-0.6 * mm); };
  if (diameter_mm >= kLeastFitted_mm) return fitted(diameter_mm);
  return fitted(kLeastFitted_mm) * std::max(diameter_mm, 0.0) / kLeastFitted_mm;
}

std::array<DropClass, kDropClasses> drop_classes(const Particles& particles) {
  std::array<DropClass, kDropClasses> classes;
  double larger_per_m3 = 0.0, most_mm = std::numeric_limits<double>::infinity();
  for (std::size_t i = kDropClasses; i-- > 0;) {
    const double cube_m3 = kCubes_m[i] * kCubes_m[i] * kCubes_m[i];
    const double wanted_per_m3 = larger_per_m3 + static_cast<double>(kMostDrops) / cube_m3;
    const double all_per_m3 = particles.number_per_m3();
    const double least_mm =
        wanted_per_m3 < all_per_m3 ? std::log(all_per_m3 / wanted_per_m3) / particles.slope_per_mm : 0.0;
    const double per_m3 = std::min(wanted_per_m3, all_per_m3) - larger_per_m3;
    classes[i] = {.cube_m = kCubes_m[i],
                  .least_mm = least_mm,
                  .most_mm = most_mm,
                  .count = static_cast<std::size_t>(std::lround(per_m3 * cube_m3)),
                  .share = particles.share_of_larger(least_mm) - particles.share_of_larger(most_mm)};
    larger_per_m3 += per_m3, most_mm = least_mm;
  }
  return classes;
}

}  // namespace phare
