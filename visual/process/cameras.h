// The eyes: the driver's, one from above, one behind the car.
#pragma once

#include "config/desk.h"
#include "config/rig.h"
#include "net/messages.h"
#include "visual/renderer.h"
#include "visual/scene/scene.h"

namespace phare {

/// Length and width of the road seen by the bird's eye, and where its near edge lies ahead of the car's origin.
inline constexpr double kBirdsEyeLength_m = 100.0;
inline constexpr double kBirdsEyeWidth_m = 40.0;
inline constexpr double kBirdsEyeStart_m = 0.0;
/// The picture of it: 100 : 40.
inline constexpr PictureSize kBirdsEyePicture{1200, 480};

/// The eye of a channel, fixed to the body.
Camera driver_camera(const ChannelConfig& channel, const VehicleState& pose);

/// Straight down, the car drives to the right:
///
///       y = +20 m (left)  +------------------------------+
///                    car  |=>                            |   picture's right = car's heading, up = car's left
///       y = -20 m         +------------------------------+
///                      x = 0                         x = 100 m
///
/// Only the heading turns it, so the picture is a map of the ground. The picture must be 100 : 40.
Camera birds_eye_camera(const VehicleState& pose);

/// 9 m behind and 3.2 m above, level: shows the beam move on the road while the body pitches.
Camera chase_camera(const ChannelConfig& channel, const VehicleState& pose);

/// The whole scene from above with parallel rays.
Camera overview_camera(const Scene& scene);

Camera camera_of(CameraKind kind, const ChannelConfig& channel, const VehicleState& pose);

}  // namespace phare
