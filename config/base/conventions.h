// Angles between the conventions that meet in Phare, each turned in one place, a constant of nature, and the grid of
// places.
#pragma once

#include <cmath>
#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace phare {

inline constexpr double kGravity_mps2 = 9.80665;  // 3rd CGPM, 1901

/// Places on this grid, 0.06 mm, are added and subtracted without rounding in float32 where no sum is beyond 1024 m: a
/// corner that several pieces of a scene share is then drawn in one place, whichever origin each has.
inline constexpr double kPlaceGrid_m = 0x1p-14;
/// The nearest place on it; of one halfway the higher.
inline glm::dvec3 on_place_grid(const glm::dvec3& at_m) {
  return glm::floor(at_m / kPlaceGrid_m + 0.5) * kPlaceGrid_m;
}

/// ISO 8855 pitch of the body to the aim of a lamp fixed to it, and back: the function is its own inverse.
///
///     side view, the car drives to the right, x forward, z up; rotation about y, which points at the reader's back
///
///              z|                                  ISO 8855, right-handed about y (left):
///               |     ___----  aim > 0, beam up        pitch > 0 turns x towards -z: nose DOWN
///               |__---_______ x                    lighting engineers (UN R48, percent of aim):
///               |  ---___                              aim > 0 is UP, low beam leaves at about -0.01
///               |        ---- pitch > 0, nose down
///
/// So braking (pitch > 0) gives a negative aim: the beam falls. In radians, both relative to the horizontal.
inline double aim_from_pitch_rad(double iso_pitch_rad) {
  return -iso_pitch_rad;
}

/// Rotation world_from_car = Rz(yaw)·Ry(pitch)·Rx(roll), ISO 8855 angles in radians (yaw > 0 to the left, pitch > 0
/// nose down, roll > 0 right side down). Its columns are the car's forward, left and up directions in the world.
inline glm::dmat3 world_from_car(double roll_rad, double pitch_rad, double yaw_rad) {
  const double cr = std::cos(roll_rad), sr = std::sin(roll_rad);
  const double cp = std::cos(pitch_rad), sp = std::sin(pitch_rad);
  const double cy = std::cos(yaw_rad), sy = std::sin(yaw_rad);
  return glm::dmat3{{cy * cp, sy * cp, -sp},                                     // forward
                    {cy * sp * sr - sy * cr, sy * sp * sr + cy * cr, cp * sr},   // left
                    {cy * sp * cr + sy * sr, sy * sp * cr - cy * sr, cp * cr}};  // up
}

}  // namespace phare
