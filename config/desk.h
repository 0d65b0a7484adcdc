// The desk: what the user sets of the picture, as one value, and the one function that changes it.
//
// Keys (config/key_bindings.h), command line (config/picture_options.h), rig file ([desk]) and bus (RigControl.set) all
// say the same: the name of a setting and a value in words, "camera chase". desk_settings() is the table of them.
// Pure: no file, no socket, no device. Checked by tests/visual_process/desk_test.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "config/base/result.h"
#include "config/eye.h"
#include "config/isolux.h"

namespace phare {

/// A point whose illuminance the overlay tells.
struct Probe {
  /// Road: s along the scene's lane, to its left, above the road. Picture: shares of its width and height from the
  /// upper left corner, and what is seen there.
  enum class Frame { kCar, kWorld, kRoad, kPicture };
  Frame frame = Frame::kCar;         ///< what it is pinned to
  glm::dvec3 position_m{0.0};        ///< in that frame (docs/design.md)
  glm::dvec3 normal{0.0, 0.0, 1.0};  ///< unit, of the lit side

  friend bool operator==(const Probe&, const Probe&) = default;
};
/// Eyes that a picture can be drawn from (visual/process/cameras.h).
enum class CameraKind { kDriver, kBirdsEye, kChase, kOncoming, kWall, kLeftMirror, kInnerMirror, kRightMirror, kFree };
inline constexpr std::array<std::string_view, 9> kCameraNames{
    "driver", "birds-eye", "chase", "oncoming", "wall", "left-mirror", "inner-mirror", "right-mirror", "free"};

/// The eye that the user moves: on the car (level, turning with its heading) or in the world.
struct FreeEye {
  Probe::Frame frame = Probe::Frame::kCar;  ///< kCar or kWorld
  glm::dvec3 position_m{-6.0, 2.5, 2.2};
  double yaw_deg = -12.0;   ///< to the left
  double pitch_deg = -8.0;  ///< up
  double fov_deg = 60.0;    ///< horizontal

  friend bool operator==(const FreeEye&, const FreeEye&) = default;
};

/// A camera of the user's own, by its name: letters, digits, - and _, no more than kMostOfName, none of kCameraNames.
struct NamedEye {
  std::string name;
  FreeEye eye;

  friend bool operator==(const NamedEye&, const NamedEye&) = default;
};
inline constexpr std::size_t kMostCameras = 8, kMostOfName = 24;

/// How many cameras the picture shows: one; two, in halves; or a second one small in a corner.
enum class Layout { kFull, kSplit, kInset };
inline constexpr std::array<std::string_view, 3> kLayoutNames{"full", "split", "inset"};

/// Two designs in one picture: the one that shines on the left half and the other on the right half of the same view,
/// or by turns, half a second each; or by colour what the other has more or less, in lux or as a ratio.
enum class Compare { kOff, kSplit, kFlicker, kDifference, kRatio };
inline constexpr std::array<std::string_view, 5> kCompareNames{"off", "split", "flicker", "difference", "ratio"};

/// As the eye sees it; illuminance by colour with isolux lines; or as the eye sees it with stripes where the display
/// clips. Two designs compared: Compare says it, and not the setting "view".
enum class View { kPhoto, kFalseColour, kClipping, kDifference, kRatio };
inline constexpr std::array<std::string_view, 3> kViewNames{"photo", "false-colour", "clipping"};

/// Where illuminance is computed (docs/accuracy.md, "Illumination methods"): at every pixel; at the vertices, and
/// interpolated; as in 1998: cos(q)/r² at the vertices, times the beam as an 8-bit texture (Lecocq et al. 1999); or in
/// float64 at every pixel.
enum class Method { kFragment, kVertex, kVertex1998, kReference };
inline constexpr std::array<std::string_view, 4> kMethodNames{"fragment", "vertex", "vertex-1998", "reference"};

inline constexpr std::array<std::string_view, 4> kProbeFrameNames{"car", "world", "road", "picture"};
inline constexpr std::size_t kMostProbes = 16;

/// Levels of effects that the desk may set, from off to the finest.
inline constexpr std::array<std::string_view, 2> kOffOnNames{"off", "on"};
inline constexpr std::array<std::string_view, 6> kShadowNames{"off", "hard", "soft", "fine", "rays", "lens"};
/// The first that asks the scene's triangles at every pixel: a reference, which only the user chooses.
inline constexpr std::size_t kRayShadows = 4;
/// The first of these at which things cast with all their triangles, however far they are.
inline constexpr std::size_t kWholeCasters = 3;
inline constexpr std::array<std::string_view, 6> kFogNames{"off", "coarse", "medium", "fine", "shadowed", "finest"};

/// Of the windscreen, from standing still to its fastest.
enum class Wiper { kOff, kInterval, kSlow, kFast };
inline constexpr std::array<std::string_view, 4> kWiperNames{"off", "interval", "slow", "fast"};

inline constexpr std::array<std::string_view, 4> kWetNames{"dry", "damp", "wet", "flooded"};
/// How asphalt sends the light of street lamps to the eye: every way alike, or by an r-table (CIE 144).
inline constexpr std::array<std::string_view, 2> kAsphaltNames{"lambert", "r-table"};

/// Meteorological visibility that may be set: fog of a steam bath, and air in which nothing near is dimmed.
inline constexpr double kLeastVisibility_m = 1.0, kMostVisibility_m = 100000.0;
/// Rain and snow that may be set, mm/h of water: a cloudburst, and a snowstorm.
inline constexpr int kMostRain_mmph = 100, kMostSnow_mmph = 10;

struct Desk {
  CameraKind camera = CameraKind::kDriver;
  FreeEye free_eye;               ///< of the camera "free"
  std::vector<NamedEye> cameras;  ///< the user's own, kMostCameras at most
  std::string own_camera;         ///< which of them is seen from: the free eye, first as it stands there; empty: none
  Layout layout = Layout::kFull;
  std::string second_camera = "chase";  ///< of a layout with two: of kCameraNames or `cameras`
  bool mirrors = false;                 ///< the three mirrors as insets over the picture of another camera
  Compare compare = Compare::kOff;
  bool versus_aligned = false;        ///< the other design is turned until both cut-offs stand equally high at 25 m
  std::optional<std::size_t> versus;  ///< the other design, from 0; none: the one after that which shines
  View view = View::kPhoto;
  Method method = Method::kFragment;
  std::vector<double> isolux_lx{kIsoluxLevels_lx.begin(), kIsoluxLevels_lx.end()};  ///< rising, 1 to kMostIsoluxLevels
  double exposure_per_cdm2 = 0.3;     ///< multiplies luminance before the tone curve; fixed, so that beams compare
  EyeSetting eye;                     ///< what the eye takes for white
  std::optional<std::size_t> design;  ///< shown instead of the one that the cockpit has chosen, from 0
  std::vector<Probe> probes;          ///< at most kMostProbes, none of the picture
  std::optional<Probe> point;         ///< read lamp by lamp: what a click chooses
  double grid_m = 0.0;                ///< spacing of the grid on the road ahead; 0: none
  bool isolux = false;                ///< isolux lines on the road of the photo
  bool scale = true;                  ///< the scale of the false colours, where they are
  bool plot = false;                  ///< lux at the probes and the point over time, in the picture
  bool reach = false;                 ///< how far the beam reaches along the lane's edges, told and kept
  bool lines = true;                  ///< lines of text at the top: time, lux under the mouse, warnings
  bool instruments = true;            ///< speed, gear, lights at the lower edge
  bool effects = false;               ///< among the lines each effect with its level and the reason
  bool help = false;                  ///< every key
  bool panel = false;                 ///< what is set by the mouse (visual/process/panel.h)
  /// Levels of these effects (visual/effects.h); without one the scene decides.
  std::optional<std::size_t> shadows, depth_first, hdr_image, overlay, fog, precipitation, ground, glare, fixed_light,
      eyeshine, spray, asphalt, snow_cover_drawn, windscreen_drawn;
  std::optional<double> visibility_m;       ///< meteorological optical range (photometry/table/fog.h); none: no fog
  double rain_mmph = 0.0, snow_mmph = 0.0;  ///< of water (photometry/table/precipitation.h)
  double snow_cover_01 = 0.0;               ///< share of level ground that snow covers (shaders/lib/snow.h)
  bool windscreen = false;                  ///< one before the driver's eye, on which rain falls
  Wiper wiper = Wiper::kSlow;               ///< of it
  std::optional<std::size_t> weather_ahead;  ///< other weather is made ready before a drive in real time

  double age_years = 40.0;    ///< of who looks: light scattered in the eye (photometry/table/veil.h)
  double iris_pigment = 0.5;  ///< 0 black, 0.5 brown, 1 light, 1.2 very light and blue

  friend bool operator==(const Desk&, const Desk&) = default;
};

/// What a setting is and what it is set to, in the words of desk_settings(). No value: it is only asked for.
struct DeskCommand {
  std::string setting;
  std::string value{};

  friend bool operator==(const DeskCommand&, const DeskCommand&) = default;
};

/// What the desk cannot know of itself.
struct DeskContext {
  std::size_t designs = 1;  ///< of the rig
  /// Where the present picture is seen from, where that is not the free eye: what a camera that is added takes.
  std::optional<FreeEye> seen_from = {};
  std::string no_reference = {};  ///< why the device cannot draw by Method::kReference; empty: it can, or is not known
};

struct DeskSetting {
  std::string_view name;    ///< ends with the unit where there is one
  std::string_view values;  ///< what may be said
  std::string_view what;    ///< in a few words
  bool in_rig = true;       ///< may stand in a rig file
  Status (*set)(Desk& desk, std::string_view value, const DeskContext& context);
  std::string (*get)(const Desk& desk);  ///< a value that set() takes
  std::string_view rig_table = "desk";   ///< of the rig file, where it may stand in one
};

/// Tables of a rig file that settings stand in.
inline constexpr std::array<std::string_view, 2> kDeskTables{"desk", "weather"};

/// Every setting there is.
std::span<const DeskSetting> desk_settings();

/// Does the command. What holds then ("camera chase"), or why not; then nothing has changed.
Result<std::string> apply(Desk& desk, const DeskCommand& command, const DeskContext& context = {});

/// "camera chase", as keys and command lines have it: the first word is the setting.
DeskCommand desk_command(std::string_view words);

/// The settings that are not as in `other`, as commands that make them so.
std::vector<DeskCommand> difference(const Desk& desk, const Desk& other = {});

/// Lines of "  NAME VALUES   what it is", for help.
std::string desk_settings_text(std::string_view indent);

}  // namespace phare
