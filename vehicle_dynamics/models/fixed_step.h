// Fixed-step integrators over a plain state of doubles whose last N entries are transient slips.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>

#include "config/base/two.h"

namespace phare {

/// Cheapest first; kReference is SUNDIALS with tight tolerances, in batch and tests only (reference.h).
enum class Integrator {
  kSemiImplicitEuler,  ///< velocities first; slips implicit in their decay
  kEtd2,               ///< exponential in the slips, in single-track also in the body's springs; second order
  kRk4,                ///< Boost.odeint runge_kutta4, see rk4_step.h
  kReference
};

/// (e^z - 1)/z and (e^z - 1 - z)/z^2; series where the differences would cancel.
struct Phi {
  double one = 1.0, two = 0.5;
};
inline Phi phi(double z) {
  if (std::abs(z) < 1e-2)  // to the sixth power: below 1e-14
    return {1.0 + z * (0.5 + z * (1.0 / 6.0 + z * (1.0 / 24.0 + z * (1.0 / 120.0 + z / 720.0)))),
            0.5 + z * (1.0 / 6.0 + z * (1.0 / 24.0 + z * (1.0 / 120.0 + z * (1.0 / 720.0 + z / 5040.0))))};
  const double per_z = 1.0 / z, one = (std::exp(z) - 1.0) * per_z;
  return {one, (one - 1.0) * per_z};
}

/// The same for two at once.
struct TwoPhi {
  Two one{}, two{};
};
inline TwoPhi phi(Two z) {
  if (std::abs(z[0]) < 1e-2 || std::abs(z[1]) < 1e-2) {
    const Phi first = phi(z[0]), second = phi(z[1]);
    return {Two{first.one, second.one}, Two{first.two, second.two}};
  }
  const Two per_z = 1.0 / z, one = (exponential(z) - 1.0) * per_z;
  return {one, (one - 1.0) * per_z};
}

/// Exponential time differencing of second order (Cox, Matthews, J. Comput. Phys. 176, 2002, eq. 20 to 22): the decay
/// of the slips, taken at the start of the step, is integrated exactly, so no decay is too fast for the step; the other
/// states get Heun's method. `rates(state, t, decay)` also fills the decays of the slips.
template <std::size_t Slips, class State, class Rates>
void step_etd2(State& state, double dt, const Rates& rates) {
  constexpr std::size_t kSize = sizeof(State) / sizeof(double), kFirst = kSize - Slips;
  using Vector = std::array<double, kSize>;
  std::array<double, Slips> decay, unused;
  const auto y = std::bit_cast<Vector>(state), f = std::bit_cast<Vector>(rates(state, 0.0, decay));
  Vector a = y;
  std::array<Phi, Slips> factor;
  for (std::size_t i = 0; i < Slips; ++i) factor[i] = phi(-decay[i] * dt);
  for (std::size_t i = 0; i < kSize; ++i) a[i] += dt * (i < kFirst ? 1.0 : factor[i - kFirst].one) * f[i];
  const auto fa = std::bit_cast<Vector>(rates(std::bit_cast<State>(a), dt, unused));
  Vector next = a;
  for (std::size_t i = 0; i < kFirst; ++i) next[i] += 0.5 * dt * (fa[i] - f[i]);
  for (std::size_t i = kFirst; i < kSize; ++i) {
    const double lambda = decay[i - kFirst];
    next[i] += dt * factor[i - kFirst].two * (fa[i] + lambda * a[i] - f[i] - lambda * y[i]);
  }
  state = std::bit_cast<State>(next);
}

}  // namespace phare
