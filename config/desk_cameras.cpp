#include "config/desk_cameras.h"

#include <cctype>
#include <cmath>

#include "config/desk_words.h"

namespace phare {

using namespace desk_words;

namespace {

/// "car|world X Y Z YAW_DEG PITCH_DEG [FOV_DEG]".
Result<FreeEye> eye_of(std::span<const std::string> words) {
  const auto frames = std::span(kProbeFrameNames).first(2);
  FreeEye eye;
  const auto frame = std::ranges::find(frames, words.empty() ? "" : words.front());
  if (frame == frames.end()) return none_of(words.empty() ? "" : words.front(), frames);
  eye.frame = static_cast<Probe::Frame>(frame - frames.begin());
  if (words.size() != 6 && words.size() != 7)
    return Error{"",
                 "expected car or world, x, y, z in m, degrees to the left and up, and the field in degrees if it is "
                 "not 60"};
  const auto read = [&](std::size_t word, double least, double most, double& to) -> Status {
    const auto number = number_of(words[word], least, most);
    if (!number) return number.error();
    to = *number;
    return Done{};
  };
  for (int axis = 0; axis < 3; ++axis)
    if (const Status done = read(static_cast<std::size_t>(axis) + 1, -1e7, 1e7, eye.position_m[axis]); !done)
      return done.error();
  if (const Status done = read(4, -360.0, 360.0, eye.yaw_deg); !done) return done.error();
  if (const Status done = read(5, -89.0, 89.0, eye.pitch_deg); !done) return done.error();
  if (words.size() == 7)
    if (const Status done = read(6, 1.0, 170.0, eye.fov_deg); !done) return done.error();
  return eye;
}
std::string eye_words(const FreeEye& eye) {
  std::string text(kProbeFrameNames[static_cast<std::size_t>(eye.frame)]);
  for (int axis = 0; axis < 3; ++axis) text += " " + word_of(eye.position_m[axis]);
  return text + " " + word_of(eye.yaw_deg) + " " + word_of(eye.pitch_deg) + " " + word_of(eye.fov_deg);
}

}  // namespace

Status set_free_eye(Desk& desk, std::string_view value, const DeskContext&) {
  const auto eye = eye_of(words_of(value));
  if (!eye) return eye.error();
  desk.free_eye = *eye;
  return Done{};
}
std::string get_free_eye(const Desk& desk) {
  return eye_words(desk.free_eye);
}

Status check_camera_name(std::string_view name) {
  constexpr std::array<std::string_view, 4> kTaken{"next", "none", "add", "remove"};
  const bool letters =
      std::ranges::all_of(name, [](unsigned char c) { return std::isalnum(c) || c == '-' || c == '_'; });
  if (name.empty() || name.size() > kMostOfName || !letters)
    return Error{"", "\"" + std::string(name) + "\" is no name of a camera: 1 to " + std::to_string(kMostOfName) +
                         " letters, digits, - and _"};
  if (std::ranges::count(kCameraNames, name) + std::ranges::count(kTaken, name) > 0)
    return Error{"", "\"" + std::string(name) + "\" means something else already"};
  return Done{};
}

namespace {

/// To 1e-6 m and degrees, as lamps are (config/rig_edit.cpp): no eye sees more, and a rig file is read by people.
FreeEye rounded(FreeEye eye) {
  constexpr double kParts = 1e6;
  const auto round = [](double& value) { value = std::round(value * kParts) / kParts + 0.0; };
  for (int axis = 0; axis < 3; ++axis) round(eye.position_m[axis]);
  for (double* angle : {&eye.yaw_deg, &eye.pitch_deg, &eye.fov_deg}) round(*angle);
  return eye;
}

/// "NAME", as the picture is seen, or "NAME car|world …"; one of that name is replaced.
Status put_eye(std::vector<NamedEye>& eyes, std::span<const std::string> words, const FreeEye& seen_from) {
  const std::string name = words.empty() ? "" : words.front();
  if (const Status good = check_camera_name(name); !good) return good.error();
  FreeEye eye = rounded(seen_from);
  if (words.size() > 1) {
    const auto read = eye_of(words.subspan(1));
    if (!read) return Error{"", name + ": " + read.error().reason};
    eye = *read;
  }
  const auto there = std::ranges::find(eyes, name, &NamedEye::name);
  if (there != eyes.end())
    there->eye = eye;
  else
    eyes.push_back({name, eye});
  if (eyes.size() > kMostCameras) return Error{"", "at most " + std::to_string(kMostCameras) + " cameras"};
  return Done{};
}

bool has(const Desk& desk, std::string_view own) {
  return std::ranges::find(desk.cameras, own, &NamedEye::name) != desk.cameras.end();
}

std::vector<std::string_view> all_names(const Desk& desk) {
  std::vector<std::string_view> names(kCameraNames.begin(), kCameraNames.end());
  for (const NamedEye& one : desk.cameras) names.push_back(one.name);
  return names;
}

}  // namespace

/// "none", one eye after the other with a semicolon between them, "add …", which keeps those there are, "remove NAME".
Status set_cameras(Desk& desk, std::string_view value, const DeskContext& context) {
  std::vector<NamedEye> eyes;
  if (value.starts_with("remove ")) {
    eyes = desk.cameras;
    const std::vector<std::string> words = words_of(value.substr(7));
    const std::string name = words.size() == 1 ? words.front() : "";
    if (std::erase_if(eyes, [&](const NamedEye& one) { return one.name == name; }) == 0)
      return Error{"", "there is no camera \"" + name + "\"; there are: " + get_cameras(desk)};
  } else if (value != "none") {
    const bool add = value.starts_with("add ");
    if (add) eyes = desk.cameras, value.remove_prefix(4);
    std::vector<std::string> named;
    for (bool more = true; more;) {
      const std::size_t end = std::min(value.find(';'), value.size());
      more = end < value.size();
      const std::vector<std::string> words = words_of(value.substr(0, end));
      value.remove_prefix(std::min(end + 1, value.size()));
      if (!add && words.size() == 1)
        return Error{"",
                     words.front() + ": where is it? add " + words.front() + " takes the place of the present view"};
      if (!words.empty()) {
        if (std::ranges::count(named, words.front()) > 0) return Error{"", words.front() + " is there twice"};
        named.push_back(words.front());
      }
      if (const Status put = put_eye(eyes, words, context.seen_from.value_or(desk.free_eye)); !put) return put.error();
    }
  }
  desk.cameras = std::move(eyes);
  if (!has(desk, desk.own_camera)) desk.own_camera.clear();
  if (!has(desk, desk.second_camera) && std::ranges::count(kCameraNames, desk.second_camera) == 0)
    desk.second_camera = Desk{}.second_camera;
  return Done{};
}
std::string camera_words(const NamedEye& camera) {
  return camera.name + " " + eye_words(camera.eye);
}

std::string get_cameras(const Desk& desk) {
  std::string text;
  for (const NamedEye& one : desk.cameras) text += (text.empty() ? "" : "; ") + camera_words(one);
  return text.empty() ? "none" : text;
}

/// A kind, an eye of the user's, or the next of all of these.
Status set_camera(Desk& desk, std::string_view value, const DeskContext&) {
  const auto look_from = [&](const NamedEye& one) {
    desk.camera = CameraKind::kFree, desk.free_eye = one.eye, desk.own_camera = one.name;
    return Done{};
  };
  const auto at = std::ranges::find(desk.cameras, value == "next" ? desk.own_camera : value, &NamedEye::name);
  if (value != "next" && at != desk.cameras.end()) return look_from(*at);
  if (value == "next") {
    const bool last_kind = desk.camera == CameraKind::kFree && desk.own_camera.empty();
    const auto next = last_kind ? desk.cameras.begin() : at == desk.cameras.end() ? at : at + 1;
    if ((last_kind || at != desk.cameras.end()) && next != desk.cameras.end()) return look_from(*next);
  }
  if (!choose(kCameraNames, desk.camera, value)) return none_of(value, all_names(desk), "next");
  desk.own_camera.clear();
  return Done{};
}
std::string get_camera(const Desk& desk) {
  return desk.own_camera.empty() ? std::string(kCameraNames[static_cast<std::size_t>(desk.camera)]) : desk.own_camera;
}

Status set_second_camera(Desk& desk, std::string_view value, const DeskContext&) {
  const std::vector<std::string_view> names = all_names(desk);
  if (std::ranges::find(names, value) == names.end()) return none_of(value, names);
  desk.second_camera = value;
  return Done{};
}
std::string get_second_camera(const Desk& desk) {
  return desk.second_camera;
}

CameraEye eye_named(const Desk& desk, std::string_view name) {
  if (const auto own = std::ranges::find(desk.cameras, name, &NamedEye::name); own != desk.cameras.end())
    return {CameraKind::kFree, own->eye};
  const auto kind = std::ranges::find(kCameraNames, name);
  if (kind == kCameraNames.end()) return {};
  return {static_cast<CameraKind>(kind - kCameraNames.begin()), desk.free_eye};
}

}  // namespace phare
