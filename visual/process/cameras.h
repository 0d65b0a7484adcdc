// The eyes: the driver's, one from above, one behind the car.
#pragma once

#include <optional>
#include <vector>

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

/// The eye of a driver who comes toward the car in the lane on its left: 50 m ahead, as of the point B50L of UN R112,
/// 3.5 m to the left (a lane of ours) and 1.12 m above the ground (chosen: a car like ours), looking at the car.
/// `ground_z_m`: of the road below that eye, where it is known.
Camera oncoming_camera(const ChannelConfig& channel, const VehicleState& pose, std::optional<double> ground_z_m = {});
/// Where the oncoming eye stands, at the car's height.
glm::dvec3 oncoming_place_m(const VehicleState& pose);

/// What a flat mirror shows, left and right turned round: the eye stands at the mirror, which is as far from the
/// driver's eye as fits a car like ours (chosen). The inner one sees 20 m at 60 m straight behind (UN R46, class I);
/// the outer ones 20° from the car's side outwards (class III asks 4 m at 20 m).
Camera mirror_camera(CameraKind mirror, const ChannelConfig& channel, const VehicleState& pose);

/// The user's.
Camera free_camera(const FreeEye& eye, const VehicleState& pose);

/// The whole scene from high above, in perspective: what is drawn of the air is drawn there too.
Camera overview_camera(const Scene& scene);

/// The desk's camera. `ground_z_m`: of the road below the oncoming eye.
Camera camera_of(const Desk& desk, const ChannelConfig& channel, const VehicleState& pose,
                 std::optional<double> ground_z_m = {});

/// Beside the inner mirror and above the left one; a panel below the inner one.
inline constexpr OverlayRoom kRoomBesideMirrors{.lines_width_01 = 0.37, .lines_height_01 = 0.61, .panel_top_01 = 0.2};
/// Mirrors as insets of the frame, with what else the frame's own view has: inner, left, right.
std::vector<ViewInput> mirror_views(const ViewInput& frame, const ChannelConfig& channel, const VehicleState& pose);

}  // namespace phare
