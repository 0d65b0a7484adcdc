// Other road users on their way along the lane: reader of their TOML file, and where each is at a time.
//
// The same file and the same meaning as the control law's sensors have (python/phare/control/road_users.py); every key
// stands in docs/control-law.md. A place is a function of time alone, so lockstep, real time and replay agree and no
// message carries it. Speeds of a profile go straight from time to time, so a place is the integral of them in closed
// form; a recorded way is config/traffic/recorded_path.h. Left out: pitch and roll on the slope, one that meets
// another. Checked by tests/traffic/road_users_test.cpp, on figures that python/tests/test_control.py is held to as
// well.
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <vector>

#include "config/base/result.h"
#include "config/light_colour.h"
#include "config/road/lane.h"
#include "config/traffic/recorded_path.h"

namespace phare {

enum class RoadUserClass { car, lorry, motorcycle, bicycle, pedestrian, deer };
enum class RoadUserDirection { oncoming, same, standing };
enum class RoadUserLights { off, low, high };

/// Brake lamps burn while it loses more speed than this in the mean: UN R13-H 5.2.22.4 has a car that slows down
/// without its friction brakes show none up to 0.7 m/s² and leaves it open up to 1.3 (unconfirmed: figures by memory of
/// the rule). The mean is over kBrakesWithin_s about the moment, chosen: steps of a recording are not taken for
/// braking, and a pedal is down a little before the car slows.
inline constexpr double kBrakes_mps2 = 0.7, kBrakesWithin_s = 0.5;

/// Has high beam and brake lamps: a car, a lorry, a motorcycle.
bool has_motor(RoadUserClass kind);

struct SpeedAt {
  double time_s = 0.0, speed_mps = 0.0;
};

/// A lamp as its road user names it; who shows it chooses what is not said.
struct RoadUserLamp {
  std::filesystem::path file{};  ///< photometry, absolute; empty: none named. Not read here.
  LightColour colour{};

  bool operator==(const RoadUserLamp&) const = default;
};

struct RoadUser {
  RoadUserClass kind = RoadUserClass::car;
  RoadUserDirection direction = RoadUserDirection::oncoming;
  double start_s_m = 0.0;  ///< of its middle along the lane at time 0
  double speed_mps = 0.0;  ///< 0 or more: `direction` says which way
  /// Where it has any, in place of speed_mps: times rise, straight between them, before the first and behind the last
  /// as there.
  std::vector<SpeedAt> speeds{};
  /// Where it has one, its way: in place of direction, start_s_m, speeds, offset_m and across_*. It is there from its
  /// first row to its last, at most.
  std::optional<RecordedPath> path{};
  double offset_m = 0.0;   ///< from the lane's line, positive left; until it goes across
  /// Goes across the road from `across_from_s` until `across_to_s`, positive to the left of the lane.
  double across_mps = 0.0, across_from_s = 0.0, across_to_s = std::numeric_limits<double>::infinity();
  /// What of its headlamps burns, and with it its tail lamps; high beam is added to low beam. A pedestrian and a deer
  /// have no lamps, a bicycle has no high beam.
  RoadUserLights lights = RoadUserLights::low;
  std::optional<bool> brake{};  ///< its brake lamps burn, or do not; nothing: as it slows down
  double from_s = 0.0, to_s = std::numeric_limits<double>::infinity();  ///< there from and until, both included
  double width_m = 1.8, height_m = 1.5, length_m = 4.3;
  RoadUserLamp low_beam{}, high_beam{};                        ///< of one headlamp
  RoadUserLamp tail_lamp{}, brake_lamp{}, third_brake_lamp{};  ///< of one at its back, whose axis points backward
};

/// Errors with file:line and reason.
Result<std::vector<RoadUser>> read_road_users(const std::filesystem::path& file);

/// The lane's points with headings that do not jump by whole turns, as reading between two of them needs.
class LaneLine {
 public:
  /// At least two points whose s_m rises, as read_lane() gives them.
  explicit LaneLine(std::vector<LanePoint> points);

  /// Between the points in a straight line, `offset_m` to the left, on the line's own height. World frame, s_m and
  /// curvature of the line itself. Nothing before its first and behind its last point.
  std::optional<LanePoint> at(double s_m, double offset_m) const;
  /// Where the line comes nearest to (x, y).
  LanePoint nearest(double x_m, double y_m) const;

 private:
  std::vector<LanePoint> points_;
};

/// World frame: the middle of its length and width, on the road; heading is the way it looks, from x to y. s_m and z_m
/// of a way in the world are those of the lane where it comes nearest.
struct RoadUserPose {
  double s_m = 0.0, x_m = 0.0, y_m = 0.0, z_m = 0.0, heading_rad = 0.0;
  double speed_mps = 0.0;  ///< along its heading
  bool brakes = false;     ///< its brake lamps burn
};

/// Where it is `time_s` after the start of the drive (SimTime::seconds()); nothing while it is not there.
std::optional<RoadUserPose> pose_of(const RoadUser& user, const LaneLine& lane, double time_s);

}  // namespace phare
