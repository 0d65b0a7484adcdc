#include "visual/process/cameras.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>
#include <utility>

#include "config/base/conventions.h"

namespace phare {
namespace {

glm::dvec3 position_of(const VehicleState& pose) {
  return {pose.x_m, pose.y_m, pose.z_m};
}

}  // namespace

Camera driver_camera(const ChannelConfig& channel, const VehicleState& pose) {
  const glm::dmat3 body = world_from_car(pose.roll_rad, pose.pitch_rad, pose.yaw_rad);
  Camera camera;
  camera.eye_m = position_of(pose) + body * channel.eye_m;
  camera.world_from_eye = body * world_from_car(0.0, aim_from_pitch_rad(channel.pitch_rad), channel.yaw_rad);
  camera.fov_horizontal_rad = channel.fov_horizontal_rad;
  return camera;
}

Camera birds_eye_camera(const VehicleState& pose) {
  constexpr double kHeight_m = 80.0;
  const glm::dmat3 level = world_from_car(0.0, 0.0, pose.yaw_rad);
  const glm::dvec3 heading = level[0], left = level[1], up = level[2];
  Camera camera;
  camera.eye_m = position_of(pose) + heading * (kBirdsEyeStart_m + 0.5 * kBirdsEyeLength_m) + up * kHeight_m;
  camera.world_from_eye = glm::dmat3{-up, -heading, left};  // forward, left, up of the eye
  camera.orthographic_width_m = kBirdsEyeLength_m;
  camera.near_m = 1.0;
  camera.far_m = 2.0 * kHeight_m;
  return camera;
}

Camera chase_camera(const ChannelConfig& channel, const VehicleState& pose) {
  const glm::dmat3 level = world_from_car(0.0, 0.0, pose.yaw_rad);
  Camera camera;
  camera.eye_m = position_of(pose) + level * glm::dvec3{-9.0, 0.0, 3.2};
  camera.world_from_eye = level * world_from_car(0.0, 0.08, 0.0);  // a little down, onto the road
  camera.fov_horizontal_rad = channel.fov_horizontal_rad;
  return camera;
}

Camera overview_camera(const Scene& scene) {
  glm::dvec3 low{0.0}, high{0.0};
  for (const SceneChunk& chunk : scene.chunks) {
    low = glm::min(low, chunk.low_m);
    high = glm::max(high, chunk.high_m);
  }
  Camera camera;
  // Pictures are up to four times as wide as high; half as much again is room for what stands at the edges.
  const double width_m = 1.5 * std::max({high.x - low.x, 4.0 * (high.y - low.y), 1.0});
  const double above_m = 0.5 * width_m / std::tan(0.5 * camera.fov_horizontal_rad);
  camera.eye_m = {0.5 * (low.x + high.x), 0.5 * (low.y + high.y), high.z + above_m};
  camera.world_from_eye =
      glm::dmat3{glm::dvec3{0, 0, -1}, glm::dvec3{-1, 0, 0}, glm::dvec3{0, 1, 0}};  // forward, left, up of the eye
  camera.near_m = 1.0;
  camera.far_m = 2.0 * (above_m + width_m + high.z - low.z);
  return camera;
}

glm::dvec3 oncoming_place_m(const VehicleState& pose) {
  constexpr double kAhead_m = 50.0, kLeft_m = 3.5;
  const glm::dmat3 level = world_from_car(0.0, 0.0, pose.yaw_rad);
  return position_of(pose) + level * glm::dvec3{kAhead_m, kLeft_m, 0.0};
}

Camera oncoming_camera(const ChannelConfig& channel, const VehicleState& pose, std::optional<double> ground_z_m) {
  constexpr double kEye_m = 1.12;
  Camera camera;
  camera.eye_m = oncoming_place_m(pose);
  camera.eye_m.z = ground_z_m.value_or(camera.eye_m.z) + kEye_m;
  const glm::dvec3 way = position_of(pose) + glm::dvec3(0.0, 0.0, 0.7) - camera.eye_m;
  camera.world_from_eye = world_from_car(0.0, -std::atan2(way.z, std::hypot(way.x, way.y)), std::atan2(way.y, way.x));
  camera.fov_horizontal_rad = channel.fov_horizontal_rad;
  return camera;
}

Camera mirror_camera(CameraKind mirror, const ChannelConfig& channel, const VehicleState& pose) {
  constexpr double kRadPerDeg = std::numbers::pi / 180.0;
  const glm::dmat3 body = world_from_car(pose.roll_rad, pose.pitch_rad, pose.yaw_rad);
  glm::dvec3 at_m{channel.eye_m.x + 0.45, 0.0, channel.eye_m.z + 0.12};
  double outward_deg = 0.0, field_deg = 18.9;
  if (mirror != CameraKind::kInnerMirror) {
    const double side = mirror == CameraKind::kLeftMirror ? 1.0 : -1.0;
    at_m = {channel.eye_m.x + 0.55, 0.95 * side, channel.eye_m.z - 0.22};
    outward_deg = -10.0 * side, field_deg = 20.0;  // back and to the left is right of straight back
  }
  Camera camera;
  camera.eye_m = position_of(pose) + body * at_m;
  camera.world_from_eye = body * world_from_car(0.0, 0.02, std::numbers::pi + outward_deg * kRadPerDeg);
  camera.world_from_eye[1] = -camera.world_from_eye[1];
  camera.fov_horizontal_rad = field_deg * kRadPerDeg;
  return camera;
}

Camera free_camera(const FreeEye& eye, const VehicleState& pose) {
  constexpr double kRadPerDeg = std::numbers::pi / 180.0;
  const bool on_car = eye.frame == Probe::Frame::kCar;
  const glm::dmat3 level = on_car ? world_from_car(0.0, 0.0, pose.yaw_rad) : glm::dmat3(1.0);
  Camera camera;
  camera.eye_m = level * eye.position_m + (on_car ? position_of(pose) : glm::dvec3(0.0));
  camera.world_from_eye =
      level * world_from_car(0.0, aim_from_pitch_rad(eye.pitch_deg * kRadPerDeg), eye.yaw_deg * kRadPerDeg);
  camera.fov_horizontal_rad = eye.fov_deg * kRadPerDeg;
  return camera;
}

Camera camera_of(const Desk& desk, const ChannelConfig& channel, const VehicleState& pose,
                 std::optional<double> ground_z_m) {
  switch (desk.camera) {
    case CameraKind::kDriver:
      break;
    case CameraKind::kBirdsEye:
      return birds_eye_camera(pose);
    case CameraKind::kChase:
      return chase_camera(channel, pose);
    case CameraKind::kOncoming:
      return oncoming_camera(channel, pose, ground_z_m);
    case CameraKind::kLeftMirror:
    case CameraKind::kInnerMirror:
    case CameraKind::kRightMirror:
      return mirror_camera(desk.camera, channel, pose);
    case CameraKind::kFree:
      return free_camera(desk.free_eye, pose);
  }
  return driver_camera(channel, pose);
}

std::vector<ViewInput> mirror_views(const ViewInput& frame, const ChannelConfig& channel, const VehicleState& pose) {
  struct Inset {
    CameraKind mirror;
    const char* name;
    PicturePart part;
  };
  // Above the middle, and low at both sides, where the doors are; a ninth of the picture together.
  const Inset insets[] = {{CameraKind::kInnerMirror, "inner mirror", {0.38, 0.02, 0.24, 0.16}},
                          {CameraKind::kLeftMirror, "left mirror", {0.01, 0.62, 0.18, 0.2}},
                          {CameraKind::kRightMirror, "right mirror", {0.81, 0.62, 0.18, 0.2}}};
  std::vector<ViewInput> views;
  for (const Inset& inset : insets) {
    ViewInput view = frame;
    view.name = inset.name;
    view.camera = mirror_camera(inset.mirror, channel, pose);
    view.part = inset.part;
    view.want_image = view.want_hdr = false;
    views.push_back(std::move(view));
  }
  return views;
}

}  // namespace phare
