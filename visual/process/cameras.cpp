#include "visual/process/cameras.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <utility>

#include "config/base/conventions.h"
#include "visual/process/props.h"

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

Camera camera_of(const CameraEye& eye, const SeenBy& by) {
  const ChannelConfig& channel = by.channel;
  const VehicleState& pose = by.pose;
  switch (eye.kind) {
    case CameraKind::kDriver:
      break;
    case CameraKind::kBirdsEye:
      return birds_eye_camera(pose);
    case CameraKind::kChase:
      return chase_camera(channel, pose);
    case CameraKind::kOncoming:
      return oncoming_camera(channel, pose, by.ground_z_m);
    case CameraKind::kWall:
      return wall_camera(wall_before(by.lamps, pose));
    case CameraKind::kLeftMirror:
    case CameraKind::kInnerMirror:
    case CameraKind::kRightMirror:
      return mirror_camera(eye.kind, channel, pose);
    case CameraKind::kFree:
      return free_camera(eye.eye, pose);
  }
  return driver_camera(channel, pose);
}

FreeEye free_eye_at(const Camera& camera, const VehicleState& pose) {
  constexpr double kDegPerRad = 180.0 / std::numbers::pi;
  const glm::dmat3 car_from_world = glm::transpose(world_from_car(0.0, 0.0, pose.yaw_rad));
  const glm::dvec3 ahead = car_from_world * camera.world_from_eye[0];
  FreeEye eye{.frame = Probe::Frame::kCar, .position_m = car_from_world * (camera.eye_m - position_of(pose))};
  // Straight down looks nowhere: the car's heading is up in the picture then.
  const bool level = std::hypot(ahead.x, ahead.y) > 1e-6;
  eye.yaw_deg = level ? std::atan2(ahead.y, ahead.x) * kDegPerRad : 0.0;
  eye.pitch_deg = std::clamp(std::asin(std::clamp(ahead.z, -1.0, 1.0)) * kDegPerRad, -89.0, 89.0);
  eye.fov_deg = camera.fov_horizontal_rad * kDegPerRad;
  if (camera.orthographic_width_m > 0.0)
    eye.fov_deg = 2.0 * std::atan(0.5 * camera.orthographic_width_m / std::max(eye.position_m.z, 1.0)) * kDegPerRad;
  return eye;
}

Falling falling_past(const CameraEye& eye, const VehicleState& pose, SimTime time) {
  const bool stands = eye.kind == CameraKind::kFree && eye.eye.frame == Probe::Frame::kWorld;
  return {.time_s = time.seconds(),
          .eye_mps = stands ? glm::dvec3(0.0) : glm::dvec3(pose.vx_mps, pose.vy_mps, pose.vz_mps)};
}

void lay_out(FrameInput& frame, Layout layout, const Camera& second, std::string_view name) {
  if (layout == Layout::kFull) return;
  ViewInput view = frame;
  view.name = "second camera, " + std::string(name);
  view.camera = second;
  view.part = kInsetPart;
  view.want_image = view.want_hdr = false;
  if (layout == Layout::kSplit) {
    frame.part = {0.0, 0.0, 0.5, 1.0}, view.part = {0.5, 0.0, 0.5, 1.0};
    for (Camera* half : {&frame.camera, &view.camera}) half->seen_from_01 = 0.25, half->seen_to_01 = 0.75;
    for (ViewInput& mirror : frame.more_views) {  // half as large, in the first eye's half
      PicturePart& part = mirror.part;
      part = {0.5 * part.left_01, part.top_01, 0.5 * part.width_01, 0.5 * part.height_01};
    }
  }
  frame.more_views.push_back(std::move(view));
}

OverlayRoom room_beside(const Desk& desk) {
  if (desk.mirrors) {
    OverlayRoom room = kRoomBesideMirrors;
    if (desk.layout == Layout::kInset) room.panel_top_01 = kRoomBesideInset.panel_top_01;
    return room;
  }
  return desk.layout == Layout::kInset ? kRoomBesideInset : OverlayRoom{};
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
