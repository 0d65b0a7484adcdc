// The air that every level of the car drives through.
#pragma once

#include <cmath>

namespace phare {

inline constexpr double kAirDensity_kgpm3 = 1.2041;  // dry air, 20 degrees C, 101325 Pa

/// Drag over speed squared.
inline double drag_kgpm(double drag_area_m2) {
  return 0.5 * kAirDensity_kgpm3 * drag_area_m2;
}

/// Drag, with the sign of the speed that it is against.
inline double drag_n(double drag_area_m2, double speed_mps) {
  return drag_kgpm(drag_area_m2) * speed_mps * std::abs(speed_mps);
}

}  // namespace phare
