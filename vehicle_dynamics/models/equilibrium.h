// Where a model stands still: Newton's method on its own rates, so that what it begins with is what it would settle to.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace phare {

/// Finds `x` (within some steps of the given sizes) with rates(x) = 0, by Newton's method with differences over `size`.
/// True: every rate is below 1e-11; x is left as it was otherwise. `rates` returns N numbers.
template <std::size_t N, class Rates>
bool find_equilibrium(std::array<double, N>& x, const std::array<double, N>& size, Rates&& rates) {
  constexpr double kStill = 1e-11;
  constexpr int kMostSteps = 30;
  const auto largest = [](const std::array<double, N>& v) {
    double most = 0.0;
    for (const double value : v) most = std::isfinite(value) ? std::max(most, std::abs(value)) : 1e300;
    return most;
  };
  std::array<double, N> at = x, best = x, now = rates(at);
  double least = largest(now);
  for (int n = 0; n < kMostSteps && least > 1e-14; ++n) {
    std::array<std::array<double, N + 1>, N> m{};  // rows of the equations, the right side last
    for (std::size_t k = 0; k < N; ++k) {
      std::array<double, N> aside = at;
      aside[k] += size[k];
      const std::array<double, N> there = rates(aside);
      for (std::size_t i = 0; i < N; ++i) m[i][k] = (there[i] - now[i]) / size[k];
    }
    for (std::size_t i = 0; i < N; ++i) m[i][N] = -now[i];
    for (std::size_t k = 0; k < N; ++k) {  // Gauss, pivots by column
      std::size_t pivot = k;
      for (std::size_t i = k + 1; i < N; ++i)
        if (std::abs(m[i][k]) > std::abs(m[pivot][k])) pivot = i;
      if (!(std::abs(m[pivot][k]) > 1e-12)) return false;
      std::swap(m[k], m[pivot]);
      for (std::size_t i = 0; i < N; ++i) {
        if (i == k) continue;
        const double share = m[i][k] / m[k][k];
        for (std::size_t j = k; j <= N; ++j) m[i][j] -= share * m[k][j];
      }
    }
    for (std::size_t k = 0; k < N; ++k) at[k] += m[k][N] / m[k][k];
    now = rates(at);
    const double most = largest(now);
    if (most < least) {
      least = most, best = at;
    } else if (least < kStill) {
      break;  // rounding
    }
  }
  if (least > kStill) return false;
  x = best;
  return true;
}

}  // namespace phare
