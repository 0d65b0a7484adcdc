#include "visual/process/props.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "config/base/conventions.h"
#include "visual/process/traffic.h"
#include "visual/scene/ray_hit.h"

namespace phare {
namespace {

/// Where the mesh of the car has its rear axle, behind its middle (tools/scene/road_users.cpp), m.
constexpr double kRearAxle_m = 1.24;
/// A box that holds the car, in the frame of its rear axle on the road, m.
constexpr glm::dvec3 kCarLow_m{-1.2, -1.1, -0.5}, kCarHigh_m{3.7, 1.1, 1.7};

glm::dvec3 place_of(const VehicleState& car) {
  return {car.x_m, car.y_m, car.z_m};
}

glm::dmat3 body_of(const VehicleState& car) {
  return world_from_car(car.roll_rad, car.pitch_rad, car.yaw_rad);
}

PlacedMesh own_car(std::size_t mesh, const VehicleState& car) {
  const glm::dmat3 body = body_of(car);
  return {mesh, place_of(car) + body * glm::dvec3(kRearAxle_m, 0.0, 0.0), body};
}

}  // namespace

glm::dvec3 middle_of_low_beam(const DesignConfig& design, const Lamps::Mounts& mounts) {
  const auto low = [](const LampConfig& lamp) {
    return std::ranges::any_of(lamp.sources,
                               [](const SourceConfig& source) { return source.function == LampFunction::kLow; });
  };
  const bool any = std::ranges::any_of(design.lamps, low);
  glm::dvec3 sum{0.0};
  double count = 0.0;
  for (std::size_t slot = 0; slot < design.lamps.size(); ++slot)
    if (!any || low(design.lamps[slot])) sum += mounts.lamps[slot].position_m, count += 1.0;
  return count > 0.0 ? sum / count : sum;
}

Wall wall_before(const Lamps& lamps, const VehicleState& car) {
  return {.lamps_m = place_of(car) + body_of(car) * middle_of_low_beam(lamps.design(), lamps.mounts()),
          .world_from_wall = world_from_car(0.0, 0.0, car.yaw_rad),
          .ground_z_m = car.z_m};
}

Camera wall_camera(const Wall& wall) {
  Camera camera;
  camera.eye_m = wall.lamps_m;
  camera.world_from_eye = wall.world_from_wall;
  camera.fov_horizontal_rad = glm::radians(50.0);
  return camera;
}

RoadMarks wall_marks(const Wall& wall) {
  constexpr OverlayColour kInk{235, 235, 225}, kFaint{120, 125, 130};
  constexpr int kStep_deg = 5, kAside_deg = 20, kUp_deg = 10;
  // Down to the wall's foot on the road.
  const double foot_deg = -glm::degrees(std::atan2(wall.lamps_m.z - wall.ground_z_m, kWall_m));
  const auto at = [&](double left_deg, double up_deg) {
    constexpr double kBefore_m = kWall_m - 0.02;  // in front of the plaster
    return wall.lamps_m + wall.world_from_wall * (kBefore_m * glm::dvec3(1.0, std::tan(glm::radians(left_deg)),
                                                                         std::tan(glm::radians(up_deg))));
  };
  RoadMarks marks;
  for (int up = 0; up <= kUp_deg; up += kStep_deg) {
    marks.lines.push_back({{at(kAside_deg, up), at(-kAside_deg, up)}, up == 0 ? kInk : kFaint});
    marks.labels.push_back({at(-kAside_deg - 1.2, up), up == 0 ? "H-H" : fmt::format("{} U", up), kInk});
  }
  for (int left = -kAside_deg; left <= kAside_deg; left += kStep_deg) {
    marks.lines.push_back({{at(left, foot_deg), at(left, kUp_deg)}, left == 0 ? kInk : kFaint});
    marks.labels.push_back({at(left, kUp_deg + 0.8),
                            left == 0 ? "V-V" : fmt::format("{} {}", std::abs(left), left > 0 ? "L" : "R"), kInk});
  }
  return marks;
}

Result<Props> Props::of(const Movers& movers) {
  Props props;
  const auto car = movers.mesh("car"), wall = movers.mesh("wall");
  if (!car) return car.error();
  if (!wall) return wall.error();
  props.car_ = *car, props.wall_ = *wall;
  return props;
}

bool Props::shows_own_car(CameraKind kind, const Camera& camera, const VehicleState& car) {
  switch (kind) {
    case CameraKind::kDriver:
    case CameraKind::kWall:
    case CameraKind::kLeftMirror:
    case CameraKind::kInnerMirror:
    case CameraKind::kRightMirror:
      return false;
    case CameraKind::kBirdsEye:
    case CameraKind::kChase:
    case CameraKind::kOncoming:
    case CameraKind::kFree:
      break;
  }
  const glm::dvec3 at_m = glm::transpose(body_of(car)) * (camera.eye_m - place_of(car));
  return !(glm::all(glm::greaterThan(at_m, kCarLow_m)) && glm::all(glm::lessThan(at_m, kCarHigh_m)));
}

std::optional<PlacedMesh> Props::own_car_in(CameraKind kind, const Camera& camera, const VehicleState& car) const {
  return shows_own_car(kind, camera, car) ? std::optional(own_car(car_, car)) : std::nullopt;
}

std::vector<GlaringLamp> Props::add_to(ViewInput& view, CameraKind kind, const Lamps& lamps, const VehicleState& car,
                                       bool lit, const World& world) const {
  if (kind == CameraKind::kWall) {
    const Wall wall = wall_before(lamps, car);
    glm::dvec3 foot_m = wall.lamps_m + kWall_m * wall.world_from_wall[0];
    foot_m.z = wall.ground_z_m;
    view.moving.push_back({wall_, foot_m, wall.world_from_wall});
    static const Scene kNothing;
    World alone(kNothing, *world.meshes());
    alone.move({view.moving.back()});
    std::erase_if(view.glare,
                  [&](const GlaringLamp& lamp) { return occluder(alone, lamp.place_m, view.camera.eye_m); });
  }
  const std::optional<PlacedMesh> body = own_car_in(kind, view.camera, car);
  if (!body) return {};
  for (PlacedLamp& lamp : view.lamps)
    if (!Traffic::is_theirs(lamp)) lamp.carried_by = view.moving.size();
  view.moving.push_back(*body);
  if (!lit || view.camera.orthographic_width_m > 0.0) return {};
  auto tail = rear_lamps_into(RoadUserClass::car, {}, body->position_m, body->world_from_mesh, view.camera.eye_m, world,
                              view.air);
  view.glare.insert(view.glare.end(), tail.begin(), tail.end());
  return tail;
}

std::vector<PlacedMesh> Props::one_of_each(const glm::dvec3& place_m) const {
  return {{car_, place_m, glm::dmat3(1.0)}, {wall_, place_m, glm::dmat3(1.0)}};
}

}  // namespace phare
