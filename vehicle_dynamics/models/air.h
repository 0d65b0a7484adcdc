// The air that every level of the car drives through.
#pragma once

namespace phare {

inline constexpr double kAirDensity_kgpm3 = 1.2041;  // dry air, 20 degrees C, 101325 Pa

}  // namespace phare
