#include "visual/spray.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

namespace phare {

double spray_share_01(double speed_mps) {
  constexpr double kAt_mps = 100.0 / 3.6, kShareThere = 0.05, kMost = 0.1;
  const double faster = std::max(speed_mps - kSprayFrom_mps, 0.0) / (kAt_mps - kSprayFrom_mps);
  return std::min(kShareThere * faster * faster, kMost);
}

double spray_scatters_m2_per_m(const SprayingVehicle& vehicle, double water_mm) {
  const double volume_m2 = spray_share_01(vehicle.speed_mps) * vehicle.tyres_m * water_mm * 1e-3;
  return 1.5 * volume_m2 / (kSprayDrop_mm * 1e-3);
}

std::vector<SprayingVehicle> spraying_seen(const ViewGeometry& view, std::span<const SprayingVehicle> vehicles) {
  std::vector<SprayingVehicle> seen;
  const glm::dvec3& eye_m = view.camera().eye_m;
  const auto away_m = [&](const SprayingVehicle& vehicle) { return glm::distance(vehicle.wheels_m[0], eye_m); };
  for (const SprayingVehicle& vehicle : vehicles) {
    const glm::dvec3 middle_m = 0.5 * (vehicle.wheels_m[0] + vehicle.wheels_m[2]);
    const double radius_m = 0.5 * glm::distance(vehicle.wheels_m[0], vehicle.wheels_m[2]) + 4.0;
    if (spray_share_01(vehicle.speed_mps) > 0.0 && away_m(vehicle) <= kSprayTo_m && view.sees_ball(middle_m, radius_m))
      seen.push_back(vehicle);
  }
  std::ranges::stable_sort(seen, {}, away_m);
  if (seen.size() > kMostSpraying) seen.resize(kMostSpraying);
  std::ranges::reverse(seen);
  return seen;
}

shader::GpuSpray spray_of(const SprayingVehicle& vehicle, double water_mm, const glm::dvec3& eye_m) {
  const double step_s = kSprayAge_s / shader::kSprayPuffs, steps = std::floor(vehicle.time_s / step_s);
  constexpr double kNumbers = shader::kSprayNumbers;
  // 7919 lies far from any count of puffs that are in the air at once, so vehicles have puffs of their own.
  const double number = std::fmod(steps + 7919.0 * vehicle.number, kNumbers);
  const auto from_eye = [&](const glm::dvec3& place_m, double w) { return glm::vec4(glm::dvec4(place_m - eye_m, w)); };
  const bool farthest_now = glm::distance(vehicle.wheels_m[0], eye_m) > glm::distance(vehicle.wheels_m[2], eye_m);
  shader::GpuSpray spray{};
  spray.trail[0] = from_eye(vehicle.wheels_m[0], vehicle.time_s - steps * step_s);
  spray.trail[1] = from_eye(vehicle.wheels_m[1], number < 0.0 ? number + kNumbers : number);
  spray.trail[2] = from_eye(vehicle.wheels_m[2], farthest_now ? 1.0 : 0.0);
  spray.left = glm::vec4(glm::dvec4(vehicle.left, vehicle.half_track_m));
  spray.puff = glm::vec4(glm::dvec4(spray_scatters_m2_per_m(vehicle, water_mm) * vehicle.speed_mps * step_s,
                                    kSprayPuff_m, kSprayGrows_mps, kSprayLife_s));
  spray.light = glm::vec4(glm::dvec4(kSprayG, step_s, vehicle.tail_cd, 0.0));
  // Green follows from luminance 1.
  const glm::dvec3 colour(vehicle.tail_colour);
  for (std::size_t i = 0; i < 2; ++i) spray.tail[i] = from_eye(vehicle.tail_m[i], i == 0 ? colour.x : colour.z);
  return spray;
}

}  // namespace phare
