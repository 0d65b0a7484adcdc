// The classical Runge-Kutta step, apart from fixed_step.h as its library takes long to compile.
#pragma once

#include <array>
#include <bit>
#include <boost/numeric/odeint/algebra/array_algebra.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>

namespace phare {

/// Classical Runge-Kutta by Boost.odeint; on a fixed-size array it allocates nothing. `rates(state, t) -> State`.
template <class State, class Rates>
void step_rk4(State& state, double dt, const Rates& rates) {
  using Vector = std::array<double, sizeof(State) / sizeof(double)>;
  using boost::numeric::odeint::array_algebra;
  boost::numeric::odeint::runge_kutta4<Vector, double, Vector, double, array_algebra> stepper;
  auto y = std::bit_cast<Vector>(state);
  stepper.do_step([&](const Vector& at, Vector& rate,
                      double t) { rate = std::bit_cast<Vector>(rates(std::bit_cast<State>(at), t)); },
                  y, 0.0, dt);
  state = std::bit_cast<State>(y);
}

}  // namespace phare
