// The loop of the dynamics: fixed steps under a clock, one model, output at an exact time.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "config/base/result.h"
#include "config/road/road_surface.h"
#include "config/vehicle.h"
#include "net/messages.h"
#include "vehicle_dynamics/auto_level.h"
#include "vehicle_dynamics/car.h"
#include "vehicle_dynamics/levelling.h"
#include "vehicle_dynamics/state.h"
#include "vehicle_dynamics/step_times.h"

namespace phare {

/// What a run is made of; does not change while it runs.
struct RunSetup : CarParams {
  Level level = Level::kKinematic;
  RoadSurface road;  ///< empty: the plane at the start's height
  Road on_top;       ///< profiles and friction laid on it; its mesh and plane are not looked at
  levelling::Kind levelling = levelling::Kind::kNone;
};

/// Fixed steps, counted: step n ends at start + n·h, exact in integers, so no rounding adds up over a day.
class StepLoop {
 public:
  /// From `state` at `start` on. `steps_before`: steps a predecessor had done, when this one goes on for it.
  StepLoop(RunSetup setup, const CarState& state, SimTime start = {}, std::uint64_t steps_before = 0);

  /// All that a step changes, whole: a loop of the same setup that recalls it goes on bit for bit as this one would.
  /// Counts of times and of steps that cost nothing are not in it: they are of the process.
  struct Memory {
    CarState before, now;
    Car car;  ///< without the road
    AutoLevel choice;
    powertrain::State power;
    double plane_z_m = 0.0;
    levelling::State lamps;
    std::array<std::uint64_t, kMaxStepHashes> hashes{};
    Controls controls;
    SimTime start, dropped, paused;
    std::uint64_t steps_before = 0, steps = 0, drops = 0, controls_refused = 0;
    bool off_road = false;
    int out_of_play = 0;  ///< 0: it drives; else the number of the reason
    double still_s = 0.0, slept_s = 0.0;
  };
  Memory memory() const;
  void recall(const Memory& memory);

  /// Real time: the wall clock counts from now on, and not from the start (after recall()).
  void begin_clock();

  /// Controls for the coming steps, held until the next call. Not finite: refused and counted, the last ones stay.
  void set_controls(const Controls& controls);

  /// Lockstep: all steps until `time` is reached. Any length, exactly the steps it takes.
  void run_to(SimTime time);

  /// Real time: the steps due `elapsed` after the start, but no more than max_catch_up(). Time beyond is dropped:
  /// simulated time then lags behind, so overload slows the car down instead of the machine. Returns the steps done.
  int catch_up(SimTime elapsed);

  /// Real time: `elapsed` goes on but the car does not (pause).
  void skip(SimTime paused);

  /// The car at `time`: between the last two steps, else the nearer of them. Step, hash and lag are filled in; level
  /// pose gives the record at exactly `time`.
  VehicleState at(SimTime time) const;

  /// Hashes of the steps after step number `step`, oldest first, the newest kMaxStepHashes at most.
  std::vector<std::uint64_t> hashes_after(std::uint64_t step) const;

  SimTime start() const { return start_; }  ///< where the steps count from, a predecessor's where one is recalled
  SimTime time() const { return time_of(steps_); }  ///< of the newest step
  std::uint64_t steps() const { return steps_before_ + steps_; }
  std::uint64_t steps_done() const { return steps_; }  ///< by this loop itself
  const CarState& state() const { return now_; }
  SimTime dropped() const { return dropped_; }
  std::uint64_t drops() const { return drops_; }  ///< how often time was dropped
  std::uint64_t controls_refused() const { return controls_refused_; }
  double slept_s() const { return slept_s_; }  ///< held by brakes and settled: the car is where it was, at no cost
  bool off_road() const { return off_road_; }  ///< a wheel has been where there is no surface
  /// Why the car stays where it is for good, nullptr while it drives: no level has a body that touches the road, and no
  /// number that is not one leaves this loop.
  const char* out_of_play() const { return out_of_play_; }
  const StepTimes& times() const { return times_; }
  const RunSetup& setup() const { return setup_; }
  Level level_now() const { return car_.level(); }  ///< of level auto the one that runs
  const AutoLevel& choice() const { return auto_; }

  /// 25 steps, and no more than 50 ms of simulated time; at least one.
  int max_catch_up() const;

 private:
  SimTime time_of(std::uint64_t step) const {
    return SimTime{start_.ns + static_cast<std::int64_t>(step) * setup_.step.ns};
  }
  void step_once();
  void move(double dt);
  void begin_at(const CarState& state);
  void begin_standing();
  bool sleeps(double dt);
  void stay_if_lost();
  void choose_level(double dt);
  void take_input_from_shown();
  void take_shown();
  const Road& road();
  std::uint64_t hash() const;

  RunSetup setup_;
  CarState before_, now_;
  Car car_;
  Road road_;
  AutoLevel auto_;
  powertrain::State power_;
  levelling::State lamps_;
  std::array<std::uint64_t, kMaxStepHashes> hashes_{};  ///< of the newest steps, step n at n modulo size
  Controls controls_;
  SimTime start_;
  SimTime clock_from_;  // when the wall clock of catch_up() began to count, had nothing been dropped
  std::uint64_t steps_before_ = 0;
  std::uint64_t steps_ = 0;
  SimTime dropped_;
  std::uint64_t drops_ = 0;
  SimTime paused_;
  std::uint64_t controls_refused_ = 0;
  bool off_road_ = false;
  const char* out_of_play_ = nullptr;
  bool fresh_ = false;  ///< put on the road at rest, and has not settled there yet
  double still_s_ = 0.0, slept_s_ = 0.0;
  StepTimes times_;
};

}  // namespace phare
