// The rig file: which car, scene, lamps, views and processes belong together. Reader of config/rigs/*.toml.
// Keys in the file carry degrees where the name ends in _deg; here everything is SI.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/base/result.h"
#include "config/bus_key.h"
#include "config/bus_places.h"
#include "config/desk.h"
#include "shaders/sizes.h"

namespace phare {

enum class LampFunction { kPosition, kLow, kHigh, kFog, kDaytime, kCornering };

/// Which direction of a type C (or EULUMDAT) table is the optical axis: gamma 0, or C 0 / gamma 90. The format leaves
/// it open.
enum class GammaAxis { kGamma0, kGamma90 };

/// How a beam image is stored and looked up, from the cheapest to the table itself
/// (visual/photometry/beam/image_levels.h).
enum class ImageLevel { kNormalised8, kHalfEven, kHalfNodes, kFloatNodes };
inline constexpr std::array<std::string_view, 4> kImageLevelNames{"normalised-8bit-1999", "half-float-texture-filter",
                                                                  "half-float-native-nodes", "float32-native-nodes"};

/// Of lamps and eyes, along each axis of the car; the bus passes lamps on as far (net/wire_ranges.cpp).
inline constexpr double kFarthestFromCar_m = 50.0;

/// Colour temperatures of a source, K: where the fit of Kim et al. 2002 to the black body's colour holds.
inline constexpr double kCoolestSource_k = 1667.0, kHottestSource_k = 25000.0;

/// One photometry file, mounted. Aim turns the lamp axes in the car frame: R = Rz(yaw)·Ry(-pitch)·Rx(roll).
struct SourceConfig {
  LampFunction function = LampFunction::kLow;
  std::filesystem::path file;  ///< resolved, absolute
  GammaAxis axis = GammaAxis::kGamma0;
  double c0_turn_deg = 0.0;  ///< type C, EULUMDAT: where the file's plane C 0 lies (readers/read_lamp.h)
  bool mirror = false;       ///< left and right turned round: for the other side of the road, or a clockwise file
  std::size_t lamp_set = 1;  ///< EULUMDAT: which of the file's lamp sets, from 1
  std::size_t emitter = 1;   ///< TM-33: which of the file's emitters, from 1
  double distance_m = 0.0;   ///< CSV in lux that states no distance of its own; 0: none given
  double scale = 1.0;        ///< multiplies candela
  double yaw_rad = 0.0;      ///< > 0 left
  double pitch_rad = 0.0;    ///< > 0 up, as lighting engineers aim
  double roll_rad = 0.0;     ///< > 0 right side down
  double colour_temperature_k = 5000.0;
  std::optional<glm::dvec2> chromaticity_xy{};  ///< CIE 1931; in place of the colour temperature
  std::filesystem::path spectrum{};  ///< what chromaticity_xy is of (config/spectrum.h), resolved; empty: none
  std::filesystem::path pixels{};               ///< a pixel light: the picture it begins with, resolved; empty: none
  std::filesystem::path pixel_map{};  ///< where its pixels shine, resolved; empty: evenly over the table's angles

  bool operator==(const SourceConfig&) const = default;
};

/// How the adjuster of a lamp stands, which turns all of its sources up or down together, on top of their own angles.
struct AimConfig {
  enum class Kind {
    kAsFiled,  ///< not turned
    kCutoff,   ///< the cut-off of its passing (else fog) beam on the line of the rule
               ///< (visual/photometry/bench/lamp_aim.h)
    kTurned    ///< by up_rad
  };
  Kind kind = Kind::kAsFiled;
  double up_rad = 0.0;  ///< kTurned: > 0 up

  bool operator==(const AimConfig&) const = default;
};

/// Sources at one position. Everything that shines from here becomes one beam image.
struct LampConfig {
  std::string name;
  glm::dvec3 position_m{0.0};  ///< car frame
  std::vector<SourceConfig> sources;
  AimConfig aim{};

  bool operator==(const LampConfig&) const = default;
};

/// A named set of lamps; designs are swapped while driving.
struct DesignConfig {
  std::string name;
  std::vector<LampConfig> lamps;

  bool operator==(const DesignConfig&) const = default;
};

/// The moon over the scene, as long as a drive lasts.
struct MoonConfig {
  double azimuth_rad = 0.0;     ///< from x toward y
  double elevation_rad = 0.7;   ///< above the horizon
  double illuminance_lx = 0.2;  ///< on a plane that faces it: full moon, high up, 0.2 to 0.27 lx

  bool operator==(const MoonConfig&) const = default;
};

/// One visual process: its window and its eye.
struct ChannelConfig {
  std::string name = "front";
  int width_px = 1280;
  int height_px = 720;
  double fov_horizontal_rad = 1.0471975511965976;
  glm::dvec3 eye_m{1.6, 0.37, 1.22};  ///< car frame
  double yaw_rad = 0.0;               ///< > 0 left
  double pitch_rad = 0.0;             ///< > 0 up
  BusPlace place{};                   ///< the machine that draws it

  bool operator==(const ChannelConfig&) const = default;
};

struct Rig {
  std::filesystem::path file;
  std::string name;
  std::string bind_address = "127.0.0.1";  ///< of every process that has no place of its own below
  BusPlaces places{};
  std::uint16_t port_base = 47000;
  std::optional<BusKey> bus_key{};            ///< of [bus] key_file: 64 hexadecimal digits; required off loopback
  std::filesystem::path key_file{};           ///< resolved; empty: none
  bool run_key = true;                        ///< on loopback, without a key_file: a key for each run (net/run_key.h)
  std::int64_t frame_rate_hz = 60;            ///< of lockstep frames
  bool real_time_priority = true;             ///< in real time, of cockpit and dynamics, where the kernel allows it
  std::filesystem::path scene_file;           ///< glTF; resolved
  std::filesystem::path traffic_file;         ///< other road users (config/traffic/), resolved; empty: none
  std::filesystem::path street_lamps_file{};  ///< config/street_lamps.h, resolved; empty: none
  std::optional<MoonConfig> moon{};           ///< nothing: it does not shine
  std::filesystem::path vehicle_file;         ///< resolved
  std::filesystem::path cockpit_file;         ///< resolved
  std::string dynamics_level = "kinematic";
  double dynamics_step_s = 0.002;
  bool high_keeps_low = true;  ///< low beam stays lit under high beam
  bool keep_design = false;    ///< a change of design that was recorded is left out; by hand it is not
  ImageLevel beam_image = ImageLevel::kFloatNodes;
  Desk desk{};  ///< the picture as it begins: [desk] and [eye]
  std::vector<ChannelConfig> channels;
  std::vector<DesignConfig> designs;

  bool operator==(const Rig&) const = default;
};

/// Every address of the rig's bus that is named.
std::vector<std::string> bus_addresses(const Rig& rig);
/// Whether any of them lies beyond this machine (not 127.…): a key is required then.
bool off_loopback(const Rig& rig);

/// Reads and checks a rig file. Every key is checked; an unknown one is an error that names the nearest known key.
Result<Rig> read_rig(const std::filesystem::path& file);

/// A rig file with everything that is wrong in it. What could not be read stands as if it were not there.
struct RigReading {
  Rig rig;
  std::vector<Error> problems;
  std::vector<std::string> known_keys;  ///< that its tables may hold: "name", "bus.address", "design.lamp.source.file"
};
/// Error: no such file, or no TOML.
Result<RigReading> read_rig_whole(const std::filesystem::path& file);
/// The same from text, as if it stood in `file`.
Result<RigReading> read_rig_text(std::string_view text, const std::filesystem::path& file);

/// The lamp across the car: the same photometry on the other side, its aim mirrored about the car's middle plane.
LampConfig lamp_across(LampConfig lamp);

/// What the words of the format mean, in the order of their enumerations.
inline constexpr std::array<std::string_view, 6> kLampFunctionNames{"position", "low",     "high",
                                                                    "fog",      "daytime", "cornering"};
inline constexpr std::array<std::string_view, 2> kGammaAxisNames{"gamma0", "gamma90"};
inline constexpr std::size_t kMostLampsOfDesign = shader::kMaxLamps;  ///< positions the renderer sums per pixel
inline constexpr std::array<std::string_view, 5> kDynamicsLevelNames{"pose", "kinematic", "single-track", "full",
                                                                     "auto"};

/// Checks that the files a rig names are there: scene, vehicle, cockpit, every photometry file. The error names the
/// first that is not, and where the rig file names it.
Status check_rig_files(const Rig& rig);

/// Every file that a rig names, and its own; empty names are left out.
std::vector<std::string> files_of(const Rig& rig);

/// A lamp given on the command line:
/// FILE,x=1.5,y=0.6,z=0.65,yaw_deg=0,pitch_deg=-0.5729,roll_deg=0[,axis=gamma0|gamma90][,c0_deg=0][,mirror=0|1]
/// [,lamp_set=1][,emitter=1][,distance_m=25][,scale=1]
/// FILE may be "-", standard input. It ends at the first ",word="; a name that holds such a thing stands in double
/// quotes, a quote in it doubled.
/// `known_before`: keys that the caller has read and taken out, for the message of one that is unknown.
Result<LampConfig> parse_lamp_argument(const std::string& text, const std::vector<std::string>& known_before = {});

}  // namespace phare
