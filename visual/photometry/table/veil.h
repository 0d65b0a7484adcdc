// Light that is scattered in the eye: the veil that a glare source lays over what is seen.
//
// CIE 146:2002 (Vos 1984), "CIE general disability glare equation": L/E = 10/θ³ + (5/θ² + 0.1·p/θ)·(1 + (A/62.5)⁴) +
// 0.0025·p, θ in degrees from the line of sight, 0.1° to 100°; p: 0 for black eyes, 0.5 brown, 1.0 light, 1.2 very
// light and blue ones. Its small-angle form, 0.1° to 30°, leaves the terms with p out. CIE's age-adjusted
// Stiles–Holladay form, 1° to 30°: 10/θ²·(1 + (A/70)⁴). Checked by tests/photometry/veil_test.cpp.
#pragma once

#include <glm/vec3.hpp>

namespace phare {

/// Who looks.
struct Viewer {
  double age_years = 40.0;  ///< 40: chosen, about the mean of drivers
  double pigment = 0.5;     ///< of the iris, p above

  friend bool operator==(const Viewer&, const Viewer&) = default;
};

/// Veiling luminance over illuminance at the eye, 1/sr, of a source `angle_deg` from the line of sight; nearer than
/// 0.1° as at 0.1°, beyond 100° as there, where the equation ends.
double veil_general_per_sr(const Viewer& viewer, double angle_deg);
double veil_small_angle_per_sr(const Viewer& viewer, double angle_deg);
double veil_age_adjusted_per_sr(const Viewer& viewer, double angle_deg);

/// Factors of 1/θ², 1/θ and 1 in the general equation; that of 1/θ³ is 10 for every eye.
glm::dvec3 veil_terms(const Viewer& viewer);

/// Share of the light of a point that leaves it for angles beyond `angle_deg` (to 90°), by the general equation.
double veil_beyond(const Viewer& viewer, double angle_deg);

/// Threshold increment in percent, CIE 150: 65·L_v/L^0.8, L 0.05 to 5 cd/m².
double threshold_increment_percent(double veil_cdm2, double background_cdm2);

}  // namespace phare
