// Settings of the desk that say where it is seen from: the free eye, cameras of one's own, and which of all is chosen.
#pragma once

#include "config/desk.h"

namespace phare {

/// A name that a camera of one's own may have. Error: it may not, and why.
Status check_camera_name(std::string_view name);

/// The eye of a name: of kCameraNames, with the free eye for "free", or one of the user's own. Of another name: the
/// driver's.
struct CameraEye {
  CameraKind kind = CameraKind::kDriver;
  FreeEye eye{};  ///< of kFree
};
CameraEye eye_named(const Desk& desk, std::string_view name);

/// "NAME car|world X Y Z YAW_DEG PITCH_DEG FOV_DEG".
std::string camera_words(const NamedEye& camera);

/// As DeskSetting has them.
Status set_free_eye(Desk& desk, std::string_view value, const DeskContext& context);
Status set_cameras(Desk& desk, std::string_view value, const DeskContext& context);
Status set_second_camera(Desk& desk, std::string_view value, const DeskContext& context);
Status set_camera(Desk& desk, std::string_view value, const DeskContext& context);
std::string get_free_eye(const Desk& desk);
std::string get_cameras(const Desk& desk);
std::string get_second_camera(const Desk& desk);
std::string get_camera(const Desk& desk);

}  // namespace phare
