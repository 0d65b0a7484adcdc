// Modes of a model: eigenvalues of its derivative around a steady motion, by differences.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <complex>
#include <vector>

namespace phare::test {

/// A direction in a plain state of N doubles.
template <std::size_t N>
using Direction = Eigen::Matrix<double, static_cast<int>(N), 1>;

/// State moves along these directions and, to first order, nothing else moves it back: their span is closed. `from` are
/// orthonormal. Order: as the solver gives them.
struct Modes {
  Eigen::VectorXcd values;   ///< 1/s
  Eigen::MatrixXcd vectors;  ///< in terms of the directions, a column each
  double leak = 0.0;  ///< of the derivative out of the span, over the derivative: 0 to rounding where it is closed
};

/// Eigenvalues of `rates` (State -> State) at `at` within the span of `directions`. Central differences: the models are
/// smooth there, so the error is of h^2, 1e-12 of the value, beside a rounding of 1e-16/h.
template <class State, class Rates>
Modes modes(const State& at, const std::vector<Direction<sizeof(State) / sizeof(double)>>& directions,
            const Rates& rates) {
  constexpr std::size_t kSize = sizeof(State) / sizeof(double);
  constexpr double kStep = 1e-6;
  const auto count = static_cast<Eigen::Index>(directions.size());
  Eigen::MatrixXd span(static_cast<Eigen::Index>(kSize), count), moved(static_cast<Eigen::Index>(kSize), count);
  for (Eigen::Index k = 0; k < count; ++k) {
    span.col(k) = directions[static_cast<std::size_t>(k)];
    const auto shifted = [&](double by) {
      State s = at;
      Eigen::Map<Direction<kSize>>(reinterpret_cast<double*>(&s)) += by * span.col(k);
      const State rate = rates(s);
      return Direction<kSize>(Eigen::Map<const Direction<kSize>>(reinterpret_cast<const double*>(&rate)));
    };
    moved.col(k) = (shifted(kStep) - shifted(-kStep)) / (2.0 * kStep);
  }
  const Eigen::MatrixXd inside = span.transpose() * moved;
  const Eigen::EigenSolver<Eigen::MatrixXd> solved(inside);
  return {solved.eigenvalues(), solved.eigenvectors(), (moved - span * inside).norm() / moved.norm()};
}

/// Natural frequency and damping ratio of an oscillation.
struct Swing {
  double damped_hz = 0.0, zeta = 0.0, natural_hz = 0.0;
};
inline Swing swing(std::complex<double> value) {
  constexpr double kTwoPi = 6.283185307179586;
  return {value.imag() / kTwoPi, -value.real() / std::abs(value), std::abs(value) / kTwoPi};
}

/// The oscillations among the modes, slowest first.
inline std::vector<Swing> swings(const Modes& modes) {
  std::vector<Swing> all;
  for (const std::complex<double>& value : modes.values)
    if (value.imag() > 0.0) all.push_back(swing(value));
  std::sort(all.begin(), all.end(), [](const Swing& a, const Swing& b) { return a.natural_hz < b.natural_hz; });
  return all;
}

}  // namespace phare::test
