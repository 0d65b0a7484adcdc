// Other road users on their way along the lane: reader of their TOML file, and where each is at a time.
//
// The same file and the same meaning as the control law's sensors have (python/phare/control/road_users.py); every key
// stands in docs/control-law.md. A place is a function of time alone, so lockstep, real time and replay agree and no
// message carries it. Left out: acceleration, pitch and roll on the slope, one that meets another. Checked by
// tests/traffic/road_users_test.cpp, on figures that python/tests/test_control.py is held to as well.
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <vector>

#include "config/base/result.h"
#include "config/road/lane.h"

namespace phare {

enum class RoadUserClass { car, lorry, motorcycle, bicycle, pedestrian, deer };
enum class RoadUserDirection { oncoming, same, standing };
enum class RoadUserLights { off, low, high };

struct RoadUser {
  RoadUserClass kind = RoadUserClass::car;
  RoadUserDirection direction = RoadUserDirection::oncoming;
  double start_s_m = 0.0;  ///< of its middle along the lane at time 0
  double speed_mps = 0.0;  ///< 0 or more: `direction` says which way
  double offset_m = 0.0;   ///< from the lane's line, positive left; until it goes across
  /// Goes across the road from `across_from_s` until `across_to_s`, positive to the left of the lane.
  double across_mps = 0.0, across_from_s = 0.0, across_to_s = std::numeric_limits<double>::infinity();
  /// What of its headlamps burns, and with it its tail lamps; high beam is added to low beam. A pedestrian and a deer
  /// have no lamps, a bicycle has no headlamps.
  RoadUserLights lights = RoadUserLights::low;
  double from_s = 0.0, to_s = std::numeric_limits<double>::infinity();  ///< there from and until, both included
  double width_m = 1.8, height_m = 1.5, length_m = 4.3;
  /// Photometry of one headlamp, absolute; empty: who shows it chooses. Not read here.
  std::filesystem::path low_beam_file{}, high_beam_file{};
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

 private:
  std::vector<LanePoint> points_;
};

/// World frame: the middle of its length and width, on the road; heading is the way it looks, from x to y.
struct RoadUserPose {
  double s_m = 0.0, x_m = 0.0, y_m = 0.0, z_m = 0.0, heading_rad = 0.0;
  double speed_mps = 0.0;  ///< along its heading
};

/// Where it is `time_s` after the start of the drive (SimTime::seconds()); nothing while it is not there.
std::optional<RoadUserPose> pose_of(const RoadUser& user, const LaneLine& lane, double time_s);

}  // namespace phare
