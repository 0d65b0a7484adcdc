#include "visual/process/pick.h"

#include "visual/scene/ray_hit.h"

namespace phare {

std::optional<MeasurePoint> pick(const World& world, const Ray& ray, double most_m) {
  const std::optional<RayHit> hit = ray_hit(world, ray.origin_m, ray.direction, 0.0, most_m);
  if (!hit) return std::nullopt;
  return MeasurePoint{ray.origin_m + ray.direction * hit->distance_m, hit->normal};
}

}  // namespace phare
