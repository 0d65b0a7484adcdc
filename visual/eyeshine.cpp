#include "visual/eyeshine.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <numbers>

#include "shaders/lib/luminance.h"
#include "visual/photometry/beam/beam_image.h"
#include "visual/photometry/table/fog.h"

namespace phare {
namespace {

constexpr double kLeastSeen = 0.5 / 255.0 / 12.92;  // of 8 bits in sRGB, next to black

double cdm2_of(const glm::vec3& rgb) {
  return static_cast<double>(shader::luminance_of(rgb));
}

}  // namespace

ShiningPupil shining(const Pupil& pupil, std::span<const LightOnPupil> lights, const glm::dvec3& eye_m,
                     const Air& air) {
  ShiningPupil seen{.place_m = pupil.place_m};
  const glm::dvec3 away = eye_m - pupil.place_m;
  const double eye_distance_m = glm::length(away);
  const double cos_seen = eye_distance_m > 0.0 ? glm::dot(away, pupil.normal) / eye_distance_m : 0.0;
  if (cos_seen <= 0.0) return seen;
  seen.area_m2 = pupil.area_m2 * cos_seen;
  const glm::vec3& rho = pupil.of->reflectance;
  const double rho_a = reflectance_under_a(rho), extinction = extinction_per_m(air);
  for (const LightOnPupil& light : lights) {
    const glm::dvec3 way = light.lamp_m - pupil.place_m;
    const double distance_m = glm::length(way);
    if (!(light.candela > 0.0) || distance_m <= 0.0 || rho_a <= 0.0) continue;
    const double facing_lx =
        light.candela / (distance_m * distance_m) * transmittance(extinction, distance_m + eye_distance_m);
    const double cdm2 =
        facing_lx * sent_back_per_lx(pupil.of->retro, rho_a, way / distance_m, pupil.normal, away / eye_distance_m);
    seen.candela += rho * light.colour * static_cast<float>(cdm2 * seen.area_m2 / rho_a);
  }
  return seen;
}

std::vector<PupilInPicture> pupils_seen(const ViewGeometry& view, double width_px, double height_px,
                                        std::span<const ShiningPupil> pupils, double display_per_cdm2) {
  std::vector<PupilInPicture> seen;
  const Camera& camera = view.camera();
  if (camera.orthographic_width_m > 0.0) return seen;  // from everywhere at once, by no eye
  const glm::dmat4 ways = view.direction_from_clip();
  const double pixel = std::sqrt(2.0 * glm::length(glm::dvec3(ways[0])) / width_px * 2.0 *
                                 glm::length(glm::dvec3(ways[1])) / height_px);  // a tangent, in the picture's middle
  for (const ShiningPupil& pupil : pupils) {
    const glm::dvec3 from_eye_m = pupil.place_m - camera.eye_m;
    const double distance_m = glm::length(from_eye_m), ahead_m = glm::dot(from_eye_m, camera.world_from_eye[0]);
    if (cdm2_of(pupil.candela) <= 0.0 || ahead_m <= camera.near_m || distance_m > camera.far_m ||
        !view.sees_ball(pupil.place_m, 0.05))
      continue;
    // A pixel beside the middle takes less of the world by the third power of the cosine.
    const double pixel_sr = pixel * pixel * std::pow(ahead_m / distance_m, 3.0);
    const double pixels = pupil.area_m2 / (distance_m * distance_m * pixel_sr);
    const PupilInPicture one{
        .from_eye_m = from_eye_m,
        .sum_cdm2 = pupil.candela * static_cast<float>(1.0 / (distance_m * distance_m * pixel_sr)),
        .radius_px = std::sqrt(pixels / std::numbers::pi)};
    // Over four pixels at the worst.
    if (cdm2_of(one.sum_cdm2) / std::max(4.0, pixels) * display_per_cdm2 >= kLeastSeen) seen.push_back(one);
  }
  std::ranges::sort(seen, std::greater{}, [](const PupilInPicture& one) { return cdm2_of(one.sum_cdm2); });
  if (seen.size() > kMostPupils) seen.resize(kMostPupils);
  return seen;
}

}  // namespace phare
