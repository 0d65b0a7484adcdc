// Luminance of rough surfaces and of roads, in float64, from the directions of light and of sight.
//
// Oren and Nayar 1994: Lambertian facets in V-shaped grooves, slopes of standard deviation σ. Their full form (eq. 30:
// shadowing, masking, one interreflection) and the one with two constants, which leaves interreflection out. Light
// that comes back to a lamp beside the eye is stronger than Lambert's by orders at grazing angles, as roads under
// headlamps are. CIE r-tables (CIE 144:2001): for lamps above the road, seen 1° below the horizontal. Checked by
// tests/photometry/surface_luminance_test.cpp against another program's values.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <vector>

#include "config/base/result.h"

namespace phare {

/// How light meets a surface: unit vectors from the point, to the lamp and to the eye.
struct LightAndSight {
  glm::dvec3 normal{0.0, 0.0, 1.0};
  glm::dvec3 to_lamp{0.0, 0.0, 1.0};
  glm::dvec3 to_eye{0.0, 0.0, 1.0};
};

/// Luminance over illuminance on the surface, 1/sr. `roughness_rad`: σ. 0 where lamp or eye are below the surface, or
/// the equation is (wide slopes, light at grazing angles toward the eye).
double oren_nayar_per_sr(double reflectance, double roughness_rad, const LightAndSight& at);
/// The form with two constants, A and B.
double oren_nayar_simple_per_sr(double reflectance, double roughness_rad, const LightAndSight& at);

/// r = q·cos³γ, 1/sr, over β and tan γ: γ at the lamp between the vertical and the way to the point; β beside the plane
/// of sight.
struct ReducedLuminanceTable {
  std::vector<double> beta_deg;   ///< 0 to 180, rising
  std::vector<double> tan_gamma;  ///< from 0, rising
  std::vector<double> r_per_sr;   ///< [tan_gamma][beta]

  /// Bilinear in β and tan γ; 0 beyond the last tan γ.
  double r_at(double beta, double tangent) const;
  /// Luminance coefficient over a level road: L/E with E on the road, 1/sr.
  double q_per_sr(double beta, double tangent) const;
};

/// Luminance of a level road under a lamp of `intensity_cd` toward `point_m`: I·r/h². World: z up. 0 where the lamp is
/// not above the road.
double road_luminance_cdm2(const ReducedLuminanceTable& table, double intensity_cd, const glm::dvec3& lamp_m,
                           const glm::dvec3& point_m, const glm::dvec3& eye_m);

/// From CSV (commas, or semicolons with decimal commas): lines of comment with #, a head line "NAME,0,2,5,…" with β in
/// degrees, then lines of tan γ and r times 10⁴. Error: line and reason.
Result<ReducedLuminanceTable> read_r_table(const std::filesystem::path& file);

}  // namespace phare
