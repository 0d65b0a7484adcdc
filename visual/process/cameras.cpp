#include "visual/process/cameras.h"

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
