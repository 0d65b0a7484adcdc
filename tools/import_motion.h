// A car driven by what its CAN bus says: the recorded steering wheel through the kinematic level, its speed put on the
// recorded one at every step. What: the path of a drive without a pose, and how far that path drifts from a pose where
// there is one. Source: vehicle_dynamics/models/kinematic.h. Frame: world. Leaves out: the zero of the steering sensor,
// tyre slip; the steering ratio is that of the vehicle file. Test: tests/tools/can_import_test.cpp.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "config/road/road_surface.h"
#include "config/vehicle.h"
#include "vehicle_dynamics/state.h"

namespace phare {

/// A place of the car in the plane, and where it looks.
struct PlanePose {
  double x_m = 0.0, y_m = 0.0, yaw_rad = 0.0;
};

class DrivenCar {
 public:
  /// Starts as `start` says, m and rad; the road may be empty: a plane.
  DrivenCar(const VehicleParams& vehicle, const RoadSurface& road, CarState start);

  /// A step of dt seconds under the wheel, to the speed at its end.
  void advance(double steering_wheel_rad, double speed_mps, double dt);

  const CarState& state() const { return car_; }

 private:
  void stand(double dt);

  const VehicleParams& vehicle_;
  const RoadSurface& road_;
  CarState car_;
};

/// How far a path has drifted from the recorded one, begun at the same place and heading.
struct Drift {
  double distance_m = 0.0, heading_rad = 0.0;  ///< at the end
  double path_m = 0.0;                         ///< driven by then
  std::string text() const;                    ///< a note
};

/// `steering_wheel_rad`, `speed_mps` and `recorded`: at the time of step k, 0 … steps.
Drift drift_of(const VehicleParams& vehicle, std::int64_t steps, double dt,
               const std::function<double(std::int64_t)>& steering_wheel_rad,
               const std::function<double(std::int64_t)>& speed_mps,
               const std::function<PlanePose(std::int64_t)>& recorded);

}  // namespace phare
