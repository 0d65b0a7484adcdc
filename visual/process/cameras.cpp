#include "visual/process/cameras.h"

#include <algorithm>
#include <glm/common.hpp>

#include "config/conventions.h"

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
  camera.eye_m = {0.5 * (low.x + high.x), 0.5 * (low.y + high.y), high.z + 10.0};
  camera.world_from_eye =
      glm::dmat3{glm::dvec3{0, 0, -1}, glm::dvec3{-1, 0, 0}, glm::dvec3{0, 1, 0}};  // forward, left, up of the eye
  camera.orthographic_width_m =
      std::max({high.x - low.x, 4.0 * (high.y - low.y), 1.0});  // of pictures up to four times as wide as high
  camera.near_m = 1.0;
  camera.far_m = high.z - low.z + 20.0;
  return camera;
}

Camera camera_of(CameraKind kind, const ChannelConfig& channel, const VehicleState& pose) {
  switch (kind) {
    case CameraKind::kDriver:
      break;
    case CameraKind::kBirdsEye:
      return birds_eye_camera(pose);
    case CameraKind::kChase:
      return chase_camera(channel, pose);
  }
  return driver_camera(channel, pose);
}

}  // namespace phare
