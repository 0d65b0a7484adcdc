// The reference integrator: SUNDIALS ARKODE with tight tolerances, to measure the fixed-step ones against.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "config/base/result.h"
#include "vehicle_dynamics/models/full.h"
#include "vehicle_dynamics/models/single_track.h"

namespace phare {

/// Explicit Runge-Kutta of order 8 with error control (Fehlberg 13-7-8), relative tolerance 1e-11, absolute 1e-13. It
/// creeps up to the kinks of friction by ever shorter steps, up to 100 attempts each. Its time per step is unbounded
/// and it allocates: for batch and tests, never for real time.
class ReferenceIntegrator {
 public:
  ReferenceIntegrator();
  ~ReferenceIntegrator();
  ReferenceIntegrator(const ReferenceIntegrator&) = delete;
  ReferenceIntegrator& operator=(const ReferenceIntegrator&) = delete;

  /// Is it in this build? Error: SUNDIALS was not there, and how to get it; advance() then gives the same.
  static Status there();

  /// One step of the model, as its advance() does it but exact between decisions that are taken once a step. Error: the
  /// solver gave up, and why; the state is then as far as it came.
  Status advance(const full::Params& params, const chassis::Input& input, full::State& state, double dt);
  /// The same; the attitude must be dynamic: the quasi-static one is none of the model's rates.
  Status advance(const single_track::Params& params, const chassis::Input& input, single_track::State& state,
                 double dt);

 private:
  struct Solver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace phare
