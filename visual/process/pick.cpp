#include "visual/process/pick.h"

#include "visual/scene/ray_hit.h"

namespace phare {

std::optional<MeasurePoint> pick(const World& world, const Ray& ray, double most_m) {
  const std::optional<RayHit> hit = ray_hit(world, ray.origin_m, ray.direction, 0.0, most_m);
  if (!hit) return std::nullopt;
  return MeasurePoint{ray.origin_m + ray.direction * hit->distance_m, hit->normal};
}

std::optional<MeasurePoint> pick(const World& world, const FrameInput& picture, double aspect, double x_01,
                                 double y_01) {
  const ViewInput* view = &picture;
  for (const ViewInput& inset : picture.more_views) {
    const PicturePart& part = inset.part;
    const bool within = x_01 >= part.left_01 && x_01 < part.left_01 + part.width_01 && y_01 >= part.top_01 &&
                        y_01 < part.top_01 + part.height_01;
    if (within && !inset.own_picture) view = &inset;
  }
  const PicturePart& part = view->part;
  const ViewGeometry geometry(view->camera, aspect * part.width_01 / part.height_01);
  // Shares as pixels of a fine picture of its shape.
  constexpr int kWide_px = 1'000'000;
  const int high_px = static_cast<int>(kWide_px / geometry.aspect());
  World seen = world;
  seen.move(view->moving);
  return pick(seen, geometry.ray_through((x_01 - part.left_01) / part.width_01 * kWide_px - 0.5,
                                         (y_01 - part.top_01) / part.height_01 * high_px - 0.5, kWide_px, high_px));
}

}  // namespace phare
