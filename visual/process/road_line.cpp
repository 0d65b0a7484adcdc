#include "visual/process/road_line.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "config/base/conventions.h"

namespace phare {
namespace {

constexpr double kFromLane_m = 10.0;  // farther away a car is not on this road

glm::dvec3 origin_of(const VehicleState& car) {
  return {car.x_m, car.y_m, car.z_m};
}

}  // namespace

RoadLine::RoadLine(std::vector<LanePoint> lane, std::filesystem::path scene_file)
    : lane_(std::move(lane)), scene_file_(std::move(scene_file)) {}

const RoadSurface& RoadLine::surface() const {
  if (!surface_) {
    Result<RoadSurface> read =
        scene_file_.empty() ? Result<RoadSurface>(RoadSurface{}) : RoadSurface::read(scene_file_);
    surface_ = read ? std::move(*read) : RoadSurface{};
  }
  return *surface_;
}

std::optional<RoadLine::Place> RoadLine::place_of(const glm::dvec3& world_m) const {
  if (!has_lane()) return std::nullopt;
  Place best;
  double nearest_m2 = 1e300;
  for (std::size_t i = 0; i + 1 < lane_.size(); ++i) {
    const LanePoint &a = lane_[i], &b = lane_[i + 1];
    const double dx = b.x_m - a.x_m, dy = b.y_m - a.y_m, length_m = std::hypot(dx, dy);
    if (!(length_m > 0.0)) continue;
    const double px = world_m.x - a.x_m, py = world_m.y - a.y_m;
    double along = (px * dx + py * dy) / (length_m * length_m);
    // The ends go straight on.
    if (i > 0) along = std::max(along, 0.0);
    if (i + 2 < lane_.size()) along = std::min(along, 1.0);
    const double ox = px - along * dx, oy = py - along * dy, off_m2 = ox * ox + oy * oy;
    if (off_m2 >= nearest_m2) continue;
    nearest_m2 = off_m2;
    best = {a.s_m + along * (b.s_m - a.s_m), (dx * py - dy * px) / length_m};
    // Beside a corner of the line the distance is that to the corner.
    best.lateral_m = std::copysign(std::sqrt(off_m2), best.lateral_m);
  }
  return best;
}

MeasurePoint RoadLine::ground(double x_m, double y_m, double z_m) const {
  if (const auto point = surface().at(x_m, y_m)) return {{x_m, y_m, point->z_m}, point->normal};
  return {{x_m, y_m, z_m}, {0.0, 0.0, 1.0}};
}

MeasurePoint RoadLine::at(const Place& place) const {
  if (!has_lane()) return ground(place.s_m, place.lateral_m, 0.0);
  const auto after = std::ranges::upper_bound(lane_, place.s_m, {}, &LanePoint::s_m);
  const auto index = std::clamp<std::ptrdiff_t>(after - lane_.begin(), 1, std::ssize(lane_) - 1);
  const LanePoint &a = lane_[static_cast<std::size_t>(index) - 1], &b = lane_[static_cast<std::size_t>(index)];
  const double along = (place.s_m - a.s_m) / (b.s_m - a.s_m);
  const double dx = b.x_m - a.x_m, dy = b.y_m - a.y_m, length_m = std::max(std::hypot(dx, dy), 1e-9);
  return ground(a.x_m + along * dx - place.lateral_m * dy / length_m,
                a.y_m + along * dy + place.lateral_m * dx / length_m, a.z_m + along * (b.z_m - a.z_m));
}

RoadLine::Ahead RoadLine::ahead_of(const VehicleState& car) const {
  Ahead ahead;
  ahead.road_ = this;
  ahead.car_ = car;
  const auto here = place_of(origin_of(car));
  if (here && std::abs(here->lateral_m) < kFromLane_m) ahead.here_ = here;
  return ahead;
}

MeasurePoint RoadLine::Ahead::operator()(double ahead_m, double left_m) const {
  if (here_) return road_->at({here_->s_m + ahead_m, left_m});
  const double c = std::cos(car_.yaw_rad), s = std::sin(car_.yaw_rad);
  return road_->ground(car_.x_m + ahead_m * c - left_m * s, car_.y_m + ahead_m * s + left_m * c, car_.z_m);
}

bool RoadLine::hides(const glm::dvec3& eye_m, const glm::dvec3& point_m) const {
  constexpr double kStep_m = 4.0, kMargin_m = 0.02;
  const double distance_m = glm::distance(eye_m, point_m);
  const int steps = std::clamp(static_cast<int>(distance_m / kStep_m), 1, 200);
  for (int i = 1; i < steps; ++i) {
    const glm::dvec3 between = eye_m + (point_m - eye_m) * (static_cast<double>(i) / steps);
    const auto z_m = surface().height_m(between.x, between.y);
    if (z_m && *z_m > between.z + kMargin_m) return true;
  }
  return false;
}

std::optional<MeasurePoint> placed(const Probe& probe, const VehicleState& car, const RoadLine& road) {
  switch (probe.frame) {
    case Probe::Frame::kWorld:
      return MeasurePoint{probe.position_m, probe.normal};
    case Probe::Frame::kCar: {
      const glm::dmat3 body = world_from_car(car.roll_rad, car.pitch_rad, car.yaw_rad);
      return MeasurePoint{origin_of(car) + body * probe.position_m, body * probe.normal};
    }
    case Probe::Frame::kRoad: {
      if (!road.has_lane()) return std::nullopt;
      MeasurePoint point = road.at({probe.position_m.x, probe.position_m.y});
      point.position_m.z += probe.position_m.z;
      // A normal that is given is of the world; without one it is the road's, or up above it.
      if (probe.normal != Probe{}.normal || probe.position_m.z != 0.0) point.normal = probe.normal;
      return point;
    }
    case Probe::Frame::kPicture:
      break;
  }
  return std::nullopt;
}

}  // namespace phare
