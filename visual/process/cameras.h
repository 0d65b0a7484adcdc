// The eyes: the driver's, one from above, one behind the car; and which of them the picture shows, where.
#pragma once

#include <optional>
#include <vector>

#include "config/desk_cameras.h"
#include "config/rig.h"
#include "net/messages.h"
#include "visual/process/lamps.h"
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

/// Where a picture is seen from, and with what.
struct SeenBy {
  const ChannelConfig& channel;
  const Lamps& lamps;  ///< of the car
  const VehicleState& pose;
  std::optional<double> ground_z_m{};  ///< of the road below the oncoming eye
};
Camera camera_of(const CameraEye& eye, const SeenBy& by);
/// The free eye that sees the same way, level, on the car; of parallel rays one as high whose picture is as wide at the
/// car's height.
FreeEye free_eye_at(const Camera& camera, const VehicleState& pose);
/// How the eye goes through what falls: with the car, or it stands in the world.
Falling falling_past(const CameraEye& eye, const VehicleState& pose, SimTime time);

/// Room for the second camera of Layout::kInset: in the upper right corner, clear of the mirrors and of the scale of
/// colours.
inline constexpr PicturePart kInsetPart{0.625, 0.02, 0.30, 0.30};
inline constexpr OverlayRoom kRoomBesideInset{.lines_width_01 = 0.61, .panel_top_01 = 0.34};
/// What mirrors and the second camera leave.
OverlayRoom room_beside(const Desk& desk);
/// The layout: of the picture's own view the part that it leaves to it, and the second camera beside it, with what else
/// the picture's own view has. In halves each shows the middle of what it sees.
void lay_out(FrameInput& frame, Layout layout, const Camera& second, std::string_view name);

/// Beside the inner mirror and above the left one; a panel below the inner one.
inline constexpr OverlayRoom kRoomBesideMirrors{.lines_width_01 = 0.37, .lines_height_01 = 0.61, .panel_top_01 = 0.2};
/// Mirrors as insets of the frame, with what else the frame's own view has: inner, left, right.
std::vector<ViewInput> mirror_views(const ViewInput& frame, const ChannelConfig& channel, const VehicleState& pose);

}  // namespace phare
