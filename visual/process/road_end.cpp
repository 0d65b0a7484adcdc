#include "visual/process/road_end.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "visual/process/pick.h"

namespace phare {
namespace {

constexpr double kAbove_m = 2.0, kBelow_m = 30.0;  // where ground is looked for: a car may hang over a slope's edge
constexpr double kLoop_m = 10.0;                   // a lane whose ends are nearer than that goes round
constexpr double kTold_m = 1.0;                    // a car that starts on the first point is not past it

double apart_m(const LanePoint& point, double x_m, double y_m) {
  return std::hypot(point.x_m - x_m, point.y_m - y_m);
}

/// How far the car is beyond the point, along the lane.
double beyond_m(const LanePoint& point, const VehicleState& car) {
  return (car.x_m - point.x_m) * std::cos(point.heading_rad) + (car.y_m - point.y_m) * std::sin(point.heading_rad);
}

}  // namespace

RoadEnd::RoadEnd(const Scene& scene, std::vector<LanePoint> lane) : scene_(scene), lane_(std::move(lane)) {
  if (lane_.size() < 2 || apart_m(lane_.front(), lane_.back().x_m, lane_.back().y_m) < kLoop_m) lane_.clear();
  has_ground_ = std::ranges::any_of(scene.chunks, [](const SceneChunk& chunk) {
    return chunk.node.starts_with("road") || chunk.node.starts_with("ground");
  });
}

bool RoadEnd::past_end(const VehicleState& car) const {
  if (lane_.empty()) return false;
  const auto nearest =
      std::ranges::min_element(lane_, {}, [&](const LanePoint& point) { return apart_m(point, car.x_m, car.y_m); });
  if (nearest == lane_.begin()) return beyond_m(*nearest, car) < -kTold_m;
  return nearest + 1 == lane_.end() && beyond_m(*nearest, car) > kTold_m;
}

RoadPlace RoadEnd::of(const VehicleState& car) const {
  const Ray down{{car.x_m, car.y_m, car.z_m + kAbove_m}, {0.0, 0.0, -1.0}};
  if (has_ground_ && !pick(scene_, down, kAbove_m + kBelow_m)) return RoadPlace::kNoGround;
  return past_end(car) ? RoadPlace::kPastEnd : RoadPlace::kThere;
}

std::string road_end_line(RoadPlace place) {
  switch (place) {
    case RoadPlace::kThere:
      return "";
    case RoadPlace::kPastEnd:
      return "THE ROAD ENDS HERE: past the end of its lane";
    case RoadPlace::kNoGround:
      break;
  }
  return "THE ROAD HAS ENDED: nothing of the scene is below the car";
}

}  // namespace phare
