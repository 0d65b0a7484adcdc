// A driver for batch runs: holds a speed with the pedals, follows a path with the wheel.
//
// What: accelerator and brake from the error in speed; the road wheels' angle from a point of the path ahead.
// Source: pure pursuit, R. C. Coulter, "Implementation of the Pure Pursuit Path Tracking Algorithm", CMU-RI-TR-92-01,
//   1992, with a preview time instead of a distance; proportional and integral control of speed. Gains chosen for
//   passenger cars from 2 to 60 m/s.
// Frame: position and heading of the car's origin; steer > 0 to the left.
// Leaves out: reaction time, knowing how slippery it is, recovering from a skid.
// Tests: tests/vehicle_dynamics/manoeuvre_test.cpp.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "config/road/lane.h"

namespace phare::batch {

struct DriverOptions {
  std::optional<double> hold_speed_mps;
  double hold_until_x_m = std::numeric_limits<double>::infinity();  ///< beyond it the pedals are let go
  std::vector<LanePoint> path;                                      ///< empty: the inputs steer
  double preview_s = 0.7;                                           ///< of the way ahead that is looked at
  double least_preview_m = 3.0;                                     ///< at walking pace
  double most_rate_radps = 0.7;  ///< of the road wheels: 640 degrees a second at a ratio of 16
};

class Driver {
 public:
  explicit Driver(const DriverOptions& options) : o_(options) {}

  struct Pedals {
    double accelerator_01 = 0.0, brake_01 = 0.0;
  };
  /// Pedals for the coming step. Needs hold_speed_mps.
  Pedals pedals(double x_m, double speed_mps, double dt);

  /// Mean angle of the front wheels for the coming step, from the one of the step before. Needs a path.
  double steer_rad(double x_m, double y_m, double yaw_rad, double speed_mps, double wheelbase_m, double lock_rad,
                   double before_rad, double dt);

  /// The path lies behind the car.
  bool arrived() const { return arrived_; }

 private:
  DriverOptions o_;
  double integral_ = 0.0;
  std::size_t at_ = 0;  // of the path, the point last passed
  bool arrived_ = false;
};

}  // namespace phare::batch
