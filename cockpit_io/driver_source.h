// A scripted driver who follows a lane, for drives of our own.
// What: steering by pure pursuit, speed by a profile over the lane that keeps lateral, driving and braking acceleration
// within comfort, lights by a list of events. Source: pure pursuit: R. C. Coulter, CMU-RI-TR-92-01, 1992. Frame: world;
// the lane CSV gives the line the car's origin (rear axle) is to follow. Leaves out: traffic, reaction time, tyre slip.
// Tests: tests/cockpit_io/driver_test.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cockpit_io/source.h"
#include "config/base/result.h"
#include "config/road/lane.h"

namespace phare {

/// A stretch of the lane where the driver keeps below a speed: taken from the script's [[slow]].
struct SlowStretch {
  double from_s_m = 0.0, to_s_m = 0.0;
  double speed_mps = 0.0;
  std::optional<double> brake_mps2;  ///< brake this hard, beginning at from_s_m; else brake in comfort before it
};

struct LightEvent {
  std::optional<double> at_s_m, at_t_s;  ///< one of the two
  std::optional<LightSwitch> light;
  double flash_s = 0.0;  ///< flash that long; 0: no flash
  std::optional<bool> fog_front;
  int design_steps = 0;  ///< > 0: next, that many times; < 0: previous
};

struct DriverScript {
  std::filesystem::path file, lane_file;
  double end_s_m = 0.0;  ///< the drive ends here, or
  double end_t_s = 0.0;  ///< at this time, whichever comes first
  double wheelbase_m = 0.0, steering_ratio = 0.0;
  double full_throttle_mps2 = 0.0, power_wpkg = 0.0, full_brake_mps2 = 0.0;  ///< what the pedals give
  double max_speed_mps = 0.0;
  double lateral_mps2 = 0.0, accelerate_mps2 = 0.0, brake_mps2 = 0.0;  ///< comfort
  LightSwitch light = LightSwitch::kLow;                               ///< at the start
  std::vector<SlowStretch> slow;
  std::vector<LightEvent> events;  ///< in the file's order
};

Result<DriverScript> read_driver_script(const std::filesystem::path& file);
Result<DriverScript> parse_driver_script(std::string_view text, const std::string& name);

/// Speed to be driven at each lane point, m/s.
std::vector<double> speed_profile(const std::vector<LanePoint>& lane, const DriverScript& script);

class DriverSource : public Source {
 public:
  static Result<std::unique_ptr<Source>> open(const std::filesystem::path& script_file);
  /// `lane` has at least two points.
  DriverSource(DriverScript script, std::vector<LanePoint> lane);

  void advance(Moment now, const VehicleState* vehicle, ControlSink& cockpit) override;
  bool plays_again() const override { return true; }
  bool ended() const override { return ended_; }

  double station_m() const { return station_m_; }  ///< progress along the lane

 private:
  void locate(const VehicleState& vehicle);
  void steer(const VehicleState& vehicle);
  void pedals(const VehicleState& vehicle, double dt_s);
  void lights(Moment now, ControlSink& cockpit);
  LanePoint at(double s_m) const;
  double profile_mps(double s_m) const;

  DriverScript script_;
  std::vector<LanePoint> lane_;
  std::vector<double> speed_mps_;
  std::vector<bool> done_;  // by event
  std::optional<double> newest_s_;
  std::size_t nearest_ = 0;
  bool located_ = false;
  double station_m_ = 0.0;
  double speed_error_integral_m_ = 0.0;
  std::int64_t flash_until_ns_ = 0;
  bool ended_ = false;
  DriverInput input_;
};

}  // namespace phare
