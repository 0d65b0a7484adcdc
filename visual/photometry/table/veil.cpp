#include "visual/photometry/table/veil.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace phare {
namespace {

double fourth_power(double x) {
  return x * x * x * x;
}

double within_equation(double angle_deg) {
  return std::clamp(angle_deg, 0.1, 100.0);
}

}  // namespace

glm::dvec3 veil_terms(const Viewer& viewer) {
  const double age = 1.0 + fourth_power(viewer.age_years / 62.5);
  return {5.0 * age, 0.1 * viewer.pigment * age, 0.0025 * viewer.pigment};
}

double veil_general_per_sr(const Viewer& viewer, double angle_deg) {
  const double t = within_equation(angle_deg);
  const glm::dvec3 terms = veil_terms(viewer);
  return 10.0 / (t * t * t) + terms.x / (t * t) + terms.y / t + terms.z;
}

double veil_small_angle_per_sr(const Viewer& viewer, double angle_deg) {
  const double t = within_equation(angle_deg);
  return 10.0 / (t * t * t) + 5.0 / (t * t) * (1.0 + fourth_power(viewer.age_years / 62.5));
}

double veil_age_adjusted_per_sr(const Viewer& viewer, double angle_deg) {
  const double t = within_equation(angle_deg);
  return 10.0 / (t * t) * (1.0 + fourth_power(viewer.age_years / 70.0));
}

double veil_beyond(const Viewer& viewer, double angle_deg) {
  // Midpoints over the logarithm of the angle: 400 steps are within 1e-5 of 4000.
  constexpr int kSteps = 400;
  constexpr double kRadPerDeg = std::numbers::pi / 180.0;
  const double from = std::log(within_equation(angle_deg)), step = (std::log(90.0) - from) / kSteps;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double t = std::exp(from + (i + 0.5) * step);
    sum += veil_general_per_sr(viewer, t) * std::sin(t * kRadPerDeg) * t * kRadPerDeg * step;
  }
  return 2.0 * std::numbers::pi * sum;
}

double threshold_increment_percent(double veil_cdm2, double background_cdm2) {
  return 65.0 * veil_cdm2 / std::pow(background_cdm2, 0.8);
}

}  // namespace phare
