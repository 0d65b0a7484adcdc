#include "vehicle_dynamics/models/ride.h"

#include <algorithm>
#include <cmath>

namespace phare::ride {
namespace {

template <std::size_t N>
using Matrix = std::array<std::array<double, N>, N>;

template <std::size_t N>
Matrix<N> product(const Matrix<N>& a, const Matrix<N>& b) {
  Matrix<N> c{};
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t k = 0; k < N; ++k)
      for (std::size_t j = 0; j < N; ++j) c[i][j] += a[i][k] * b[k][j];
  return c;
}

// e^A: the series of A / 2^n, whose norm is below a half, squared n times.
template <std::size_t N>
Matrix<N> exponential(Matrix<N> a) {
  double norm = 0.0;
  for (const auto& row : a) {
    double sum = 0.0;
    for (const double v : row) sum += std::abs(v);
    norm = std::max(norm, sum);
  }
  int squarings = 0;
  for (; norm > 0.5; norm *= 0.5) ++squarings;
  for (auto& row : a)
    for (double& v : row) v = std::ldexp(v, -squarings);
  Matrix<N> sum{}, term{};
  for (std::size_t i = 0; i < N; ++i) sum[i][i] = term[i][i] = 1.0;
  constexpr int kTerms = 14;  // 0.5^14 / 14! is below the last bit
  for (int n = 1; n <= kTerms; ++n) {
    term = product(term, a);
    for (std::size_t i = 0; i < N; ++i)
      for (std::size_t j = 0; j < N; ++j) sum[i][j] += (term[i][j] /= n);
  }
  for (; squarings > 0; --squarings) sum = product(sum, sum);
  return sum;
}

}  // namespace

// A push and its growth are taken as states of their own, so one exponential gives all three parts:
// d/dt (body, push, growth) = (L body + B push, growth / dt, 0).
Step step_of(const Springs& s, double dt) {
  Step step;
  step.dt_s = dt;
  Matrix<8> a{};
  for (std::size_t i = 0; i < 2; ++i) {
    a[i][i + 2] = dt;
    for (std::size_t j = 0; j < 2; ++j)
      a[i + 2][j] = -dt * s.stiffness_ps2[i][j], a[i + 2][j + 2] = -dt * s.damping_ps[i][j];
    a[i + 2][i + 4] = dt;
    a[i + 4][i + 6] = 1.0;
  }
  const Matrix<8> e = exponential(a);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) step.left[i][j] = e[i][j];
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 2; ++j) step.held[i][j] = e[i][j + 4], step.grown[i][j] = e[i][j + 6];

  const Matrix<4> r = exponential(Matrix<4>{
      {{0.0, dt, 0.0, 0.0}, {-dt * s.roll_stiffness_ps2, -dt * s.roll_damping_ps, dt, 0.0}, {0.0, 0.0, 0.0, 1.0}, {}}});
  for (std::size_t i = 0; i < 2; ++i) {
    step.roll_left[i] = {r[i][0], r[i][1]};
    step.roll_held[i] = r[i][2], step.roll_grown[i] = r[i][3];
  }
  return step;
}

}  // namespace phare::ride
