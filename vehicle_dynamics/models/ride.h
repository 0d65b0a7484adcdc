// The body on its springs over one fixed step, exactly.
//
// What: heave, pitch and roll of a rigid body on linear springs and dampers, pushed by accelerations that change
//   evenly during the step. Left and right are alike, so roll goes its own way; heave and pitch are coupled.
// Source: variation of constants with the exponential of the body's matrix (M. Hochbruck, A. Ostermann,
//   "Exponential integrators", Acta Numerica 19, 2010, sec. 2.1); the exponential by scaling and squaring its
//   series (C. Moler, C. Van Loan, SIAM Review 45(1), 2003, method 3), once for a step length.
// Frame: ISO 8855, heights and slopes against the horizontal as in single_track.h.
// Leaves out: all that is not linear: stops, wheels that lift. No step is too long for it; none adds or takes energy.
// Tests: tests/vehicle_dynamics/ride_test.cpp (closed form of a damped oscillation, any step; energy).
#pragma once

#include <array>
#include <cstddef>

namespace phare::ride {

/// Accelerations per unit: z'' = -stiffness z - damping z' and so on.
struct Springs {
  std::array<std::array<double, 2>, 2> stiffness_ps2{}, damping_ps{};  ///< rows and columns: heave (m), pitch (slope)
  double roll_stiffness_ps2 = 0.0, roll_damping_ps = 0.0;

  friend bool operator==(const Springs&, const Springs&) = default;
};

/// What road and tyres add beside the springs' answer to the body's own place: m/s2 and slope/s2.
struct Push {
  double heave = 0.0, pitch = 0.0, roll = 0.0;
};

/// Height and slopes, and their rates.
struct Body {
  double z_m = 0.0, pitch = 0.0, z_rate_mps = 0.0, pitch_rate_ps = 0.0;
  double roll = 0.0, roll_rate_ps = 0.0;
};

/// One step of a length, worked out beforehand.
struct Step {
  double dt_s = 0.0;  ///< 0: not worked out
  // In the order of Body: what is left of it, what a push adds that is held, and one that grows from 0 to 1.
  std::array<std::array<double, 4>, 4> left{};
  std::array<std::array<double, 2>, 4> held{}, grown{};
  std::array<std::array<double, 2>, 2> roll_left{};
  std::array<double, 2> roll_held{}, roll_grown{};
};
Step step_of(const Springs& springs, double dt_s);

/// The body after the step under a push that is held.
inline Body after(const Step& step, const Body& b, const Push& push) {
  const std::array<double, 4> at{b.z_m, b.pitch, b.z_rate_mps, b.pitch_rate_ps};
  std::array<double, 4> to{};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& m = step.left[i];
    to[i] = m[0] * at[0] + m[1] * at[1] + m[2] * at[2] + m[3] * at[3] + step.held[i][0] * push.heave +
            step.held[i][1] * push.pitch;
  }
  return {to[0],
          to[1],
          to[2],
          to[3],
          step.roll_left[0][0] * b.roll + step.roll_left[0][1] * b.roll_rate_ps + step.roll_held[0] * push.roll,
          step.roll_left[1][0] * b.roll + step.roll_left[1][1] * b.roll_rate_ps + step.roll_held[1] * push.roll};
}

/// What it adds that the push has changed by `change` at the step's end.
inline Body add(const Step& step, const Body& b, const Push& change) {
  const auto& g = step.grown;
  return {b.z_m + g[0][0] * change.heave + g[0][1] * change.pitch,
          b.pitch + g[1][0] * change.heave + g[1][1] * change.pitch,
          b.z_rate_mps + g[2][0] * change.heave + g[2][1] * change.pitch,
          b.pitch_rate_ps + g[3][0] * change.heave + g[3][1] * change.pitch,
          b.roll + step.roll_grown[0] * change.roll,
          b.roll_rate_ps + step.roll_grown[1] * change.roll};
}

}  // namespace phare::ride
