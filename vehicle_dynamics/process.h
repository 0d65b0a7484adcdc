// The dynamics on the bus: takes the driver's controls, steps the car by the wall clock or frame by frame, sends
// VehicleState.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "config/rig.h"
#include "net/bus.h"
#include "net/clock.h"
#include "net/control_desk.h"
#include "net/scheduling.h"
#include "net/state_file.h"
#include "vehicle_dynamics/begin.h"
#include "vehicle_dynamics/step.h"
#include "vehicle_dynamics/step_times.h"

namespace phare {

struct DynamicsOptions {
  bool lockstep = false;
  std::filesystem::path stats_file{};  ///< empty: no statistics
  double picture_within_s = 0.0;       ///< real time: begin when every picture is ready, after so long at the latest
};

class DynamicsProcess {
 public:
  /// `kept`: of open_state(); nothing: no state is kept.
  DynamicsProcess(Bus bus, const Rig& rig, DynamicsOptions options, std::optional<StateFile> kept, StopFlag stop);
  DynamicsProcess(const DynamicsProcess&) = delete;
  DynamicsProcess& operator=(const DynamicsProcess&) = delete;

  /// The file in which the car's state is kept for a process that takes this one's place.
  static Result<StateFile> open_state(const std::filesystem::path& file);

  /// Until told to stop; writes the statistics at the end.
  void run(Begin begin);

 private:
  using Clock = std::chrono::steady_clock;

  // What a process leaves behind for the one that takes its place.
  struct Left {
    StepLoop::Memory car;
    std::uint64_t sent_step = 0;  // the newest whose hash had been sent before this state was
    std::uint64_t switches_told = 0;
  };

  // What a rig control asked for since the last look.
  struct Requests {
    bool paused = false;
    std::optional<double> seek_s;
  };

  void run_lockstep(Begin begin);
  void run_real_time(Begin begin);
  void send_state(SimTime time, std::int64_t frame, const CockpitState* cockpit);
  void tell_once(const VehicleState& sent);
  void tell_switches();

  // process_begin.cpp: beginning, or going on for a predecessor
  void begin_at(Begin begin, SimTime time, const VehicleState& drawn);
  void keep_state(std::int64_t key);
  void recall(Begin begin, const StateFile::Saved& saved);
  std::int64_t begin_at_frame(Begin begin, std::int64_t frame);
  std::optional<SimTime> time_of_others() const;
  void go_on_in_real_time(Begin begin, const StateFile::Saved& saved);
  void begin_in_real_time(Begin begin);
  bool seek();

  Verbs verbs();
  std::string state_text() const;
  ControlReply may_seek(double to_s);
  std::string time_text() const;

  Controls controls_now(const Bus::Newest<CockpitState>& cockpit);
  void report_lag();
  nlohmann::json switch_history() const;
  nlohmann::json auto_stats() const;
  void add_loop_stats(nlohmann::json& json) const;
  void stats_once_a_second();
  void write_stats() const;

  Bus bus_;
  const Rig& rig_;
  DynamicsOptions options_;
  std::optional<StateFile> kept_;
  std::int64_t kept_next_ = 0;
  StopFlag stop_;
  Requests requests_;
  Verbs verbs_;
  ControlDesk desk_;
  std::optional<StepLoop> loop_;
  std::uint64_t switches_told_ = 0;
  std::uint64_t sent_step_ = 0;  ///< the newest step whose hash has been sent
  Scheduling scheduling_;
  StepTimes wake_late_;  ///< real time: how long after its time a wake-up came
  /// Wake-ups that fell away because the one before came a step too late; their steps are caught up.
  std::uint64_t missed_wakes_ = 0;
  bool silent_ = false, off_road_logged_ = false, lost_logged_ = false;
  std::uint64_t drops_logged_ = 0;
  Clock::time_point next_lag_log_{}, next_stats_{};
};

}  // namespace phare
