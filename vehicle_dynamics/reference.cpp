#include "vehicle_dynamics/reference.h"

#include <arkode/arkode_erkstep.h>
#include <nvector/nvector_serial.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>

namespace phare {

struct ReferenceIntegrator::Solver {
  using Rates = std::function<void(double, const double*, double*)>;

  Solver() { SUNContext_Create(nullptr, &context); }
  ~Solver() {
    drop();
    SUNContext_Free(&context);
  }
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;

  void drop() {
    if (memory) ERKStepFree(&memory);
    if (y) N_VDestroy(y);
    memory = nullptr, y = nullptr, size = 0;
  }

  static int evaluate(realtype t, N_Vector at, N_Vector rate, void* self) {
    static_cast<Solver*>(self)->rates(t, N_VGetArrayPointer(at), N_VGetArrayPointer(rate));
    const double* values = N_VGetArrayPointer(rate);
    const bool finite =
        std::all_of(values, values + N_VGetLength(rate), [](double value) { return std::isfinite(value); });
    return finite ? 0 : 1;  // 1: try a shorter step
  }

  // What the library says by itself goes nowhere: the caller is told once, and decides.
  static void silent(int, const char*, const char*, char*, void*) {}

  static Status outcome(int result, double reached_s) {
    if (result >= 0) return Done{};
    char text[160];
    const char* why = result == ARK_TOO_MUCH_WORK ? "20000 steps of its own were not enough"
                      : result == ARK_ERR_FAILURE ? "no step is short enough for its tolerances"
                      : result == ARK_RHSFUNC_FAIL || result == ARK_FIRST_RHSFUNC_ERR ||
                              result == ARK_REPTD_RHSFUNC_ERR || result == ARK_UNREC_RHSFUNC_ERR
                          ? "the car's rates are not finite"
                          : "see arkode.h for the code";
    std::snprintf(text, sizeof text, "the reference integrator (ARKODE) gave up %.3g s into its step: %s (code %d)",
                  reached_s, why, result);
    return Error{"", text};
  }

  Status step(double* state, std::size_t count, double dt, Rates with) {
    rates = std::move(with);
    if (count != size) {
      drop();
      size = count;
      y = N_VNew_Serial(static_cast<sunindextype>(count), context);
      std::copy_n(state, count, N_VGetArrayPointer(y));
      memory = ERKStepCreate(evaluate, 0.0, y, context);
      ERKStepSetTableNum(memory, ARKODE_FEHLBERG_13_7_8);
      ERKStepSStolerances(memory, 1e-11, 1e-13);
      ERKStepSetUserData(memory, this);
      ERKStepSetMaxNumSteps(memory, 20'000);
      // Friction has kinks, where a lever, a brake or a slide turns its sign. The default of 7 attempts at a step is
      // too few to shrink down to one; that, not stiffness, is what it used to give up at.
      ERKStepSetMaxErrTestFails(memory, 100);
      ERKStepSetErrHandlerFn(memory, silent, nullptr);
    } else {
      std::copy_n(state, count, N_VGetArrayPointer(y));
      ERKStepReInit(memory, evaluate, 0.0, y);
    }
    ERKStepSetStopTime(memory, dt);
    realtype reached = 0.0;
    const int result = ERKStepEvolve(memory, dt, y, &reached, ARK_NORMAL);
    std::copy_n(N_VGetArrayPointer(y), count, state);
    return outcome(result, reached);
  }

  SUNContext context = nullptr;
  void* memory = nullptr;
  N_Vector y = nullptr;
  std::size_t size = 0;
  Rates rates;
};

ReferenceIntegrator::ReferenceIntegrator() : solver_(std::make_unique<Solver>()) {}
ReferenceIntegrator::~ReferenceIntegrator() = default;

Status ReferenceIntegrator::there() {
  return Done{};
}

namespace {

template <class State>
State from_array(const double* values) {
  std::array<double, sizeof(State) / sizeof(double)> all;
  std::copy_n(values, all.size(), all.begin());
  return std::bit_cast<State>(all);
}

template <class State>
void to_array(const State& state, double* values) {
  const auto all = std::bit_cast<std::array<double, sizeof(State) / sizeof(double)>>(state);
  std::copy(all.begin(), all.end(), values);
}

}  // namespace

Status ReferenceIntegrator::advance(const full::Params& p, const chassis::Input& in, full::State& state, double dt) {
  full::Held during = full::held(p, in, state, dt);
  during.most_along_pm = during.most_across_pm = during.most_damping_nspm =
      std::numeric_limits<double>::infinity();  // what fixed steps do not bear
  const full::State before = state;
  std::array<double, full::kStateSize> y;
  to_array(state, y.data());
  Status done = solver_->step(y.data(), y.size(), dt, [&](double t, const double* at, double* rate) {
    full::State d;
    full::derivative(p, in, during, from_array<full::State>(at), t, d);
    to_array(d, rate);
  });
  state = from_array<full::State>(y.data());
  full::finish_step(during, before, state);
  return done;
}

Status ReferenceIntegrator::advance(const single_track::Params& p, const chassis::Input& in, single_track::State& state,
                                    double dt) {
  single_track::Held during = single_track::held(p, in, state, dt);
  during.most_slip_pm = std::numeric_limits<double>::infinity();
  const single_track::State before = state;
  std::array<double, single_track::kStateSize> y;
  to_array(state, y.data());
  Status done = solver_->step(y.data(), y.size(), dt, [&](double t, const double* at, double* rate) {
    single_track::State d;
    single_track::derivative(p, during, from_array<single_track::State>(at), t, d);
    to_array(d, rate);
  });
  state = from_array<single_track::State>(y.data());
  single_track::finish_step(in, during, before, state);
  return done;
}

}  // namespace phare
