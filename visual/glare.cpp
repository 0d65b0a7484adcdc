#include "visual/glare.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace phare {
namespace {

constexpr double kHalfStep = 0.5 / 255.0 / 12.92;  // of 8 bits in sRGB, next to black

double angle_deg(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180.0 / std::numbers::pi;
}

}  // namespace

GlaringLamp glaring_lamp(const glm::dvec3& lamp_m, double candela, const glm::vec3& colour, const glm::dvec3& eye_m,
                         const Air& air) {
  const double distance_m = glm::distance(lamp_m, eye_m);
  const double through_air = transmittance(extinction_per_m(air), distance_m);
  return {lamp_m, candela / (distance_m * distance_m) * through_air, colour};
}

double least_angle_deg(const ViewGeometry& view, const glm::dvec3& place_m) {
  const glm::dvec3 way_m = place_m - view.camera().eye_m;
  if (view.sees_ball(place_m, 0.0)) return 0.0;
  // The cone about the view through its corners.
  glm::dvec3 middle(0.0);
  for (const Ray& edge : view.edges()) middle += edge.direction;
  double half_deg = 0.0;
  for (const Ray& edge : view.edges()) half_deg = std::max(half_deg, angle_deg(middle, edge.direction));
  return std::max(angle_deg(middle, way_m) - half_deg, 0.0);
}

std::vector<GlaringLamp> glare_seen(const ViewGeometry& view, std::span<const GlaringLamp> sources,
                                    const Viewer& viewer, double display_per_cdm2) {
  struct Veil {
    double most_cdm2;  ///< anywhere in the view
    GlaringLamp source;
  };
  std::vector<Veil> veils;
  std::vector<GlaringLamp> seen;
  if (view.camera().orthographic_width_m > 0.0) return seen;  // from everywhere at once, by no eye
  for (const GlaringLamp& source : sources) {
    if (!(source.eye_lx > 0.0)) continue;
    const double least_deg = least_angle_deg(view, source.place_m);
    const double most_cdm2 = source.eye_lx * std::max(std::cos(least_deg * std::numbers::pi / 180.0), 0.0) *
                             veil_general_per_sr(viewer, least_deg);
    if (most_cdm2 * display_per_cdm2 >= kHalfStep) veils.push_back({most_cdm2, source});
  }
  std::ranges::stable_sort(veils, std::greater{}, &Veil::most_cdm2);
  if (veils.size() > kMostGlaringLamps) {
    const double none_cdm2 = veils[kMostGlaringLamps].most_cdm2,
                 whole_cdm2 = veils[kMostGlaringLamps - kDimmedLamps].most_cdm2;
    veils.resize(kMostGlaringLamps);
    for (Veil& veil : veils)  // of equal ones none can be told from the others
      if (whole_cdm2 > none_cdm2)
        veil.source.eye_lx *= std::min((veil.most_cdm2 - none_cdm2) / (whole_cdm2 - none_cdm2), 1.0);
  }
  for (const Veil& veil : veils)
    if (veil.source.eye_lx > 0.0) seen.push_back(veil.source);
  return seen;
}

}  // namespace phare
