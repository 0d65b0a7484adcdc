// Isolux lines: the levels that every picture of Phare draws when nothing else is set, once.
#pragma once

#include <array>
#include <cstddef>

#include "shaders/sizes.h"

namespace phare {

/// lx, rising. 1, 3 and 5 lx are how far a beam reaches (CIE 188:2010); the others are even steps of its logarithm.
inline constexpr std::array<double, 7> kIsoluxLevels_lx{1.0, 3.0, 5.0, 10.0, 30.0, 50.0, 100.0};

/// Most levels that a picture can have.
inline constexpr std::size_t kMostIsoluxLevels = shader::kMaxIsoluxLevels;

}  // namespace phare
