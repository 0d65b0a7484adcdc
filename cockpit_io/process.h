// The cockpit on the bus: asks its source what the driver does and sends CockpitState, by the wall clock or frame by
// frame.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "cockpit_io/cockpit.h"
#include "cockpit_io/kept_design.h"
#include "cockpit_io/latency.h"
#include "cockpit_io/source.h"
#include "config/cockpit.h"
#include "config/rig.h"
#include "net/bus.h"
#include "net/clock.h"
#include "net/control_desk.h"
#include "net/scheduling.h"
#include "net/state_file.h"

namespace phare {

class CockpitProcess {
 public:
  /// `stats_file` may be empty: no statistics; `state_file` too: nothing is left for a successor.
  CockpitProcess(Bus bus, std::unique_ptr<Source> source, const Rig& rig, CockpitConfig config,
                 std::filesystem::path stats_file, std::filesystem::path state_file, StopFlag stop);

  /// Opens the state file, and takes up what a predecessor has left in it.
  Status take_up_state();
  CockpitProcess(const CockpitProcess&) = delete;
  CockpitProcess& operator=(const CockpitProcess&) = delete;

  /// Sends 100 times a second, and at once when a light changes, until told to stop. With `picture_within` it waits
  /// that long for a car, which waits for the picture, before it says anything.
  void run_real_time(std::chrono::nanoseconds picture_within = {});

  /// Answers FrameReport(j) of all channels with CockpitState(j + 1), until told to stop.
  void run_lockstep();

 private:
  using Clock = std::chrono::steady_clock;

  Cockpit new_cockpit() const;
  Verbs verbs();
  void take_source(std::unique_ptr<Source> source);
  void begin_anew();
  void remember(Memory& memory);
  void leave_state();
  void go_on_with_design(Moment now);
  Moment now_in_real_time();
  void evaluate(Moment now, const VehicleState* vehicle);
  void send(SimTime time, std::int64_t frame);
  void send_back(Moment now, const VehicleState* vehicle);
  void wait(std::chrono::nanoseconds at_most);

  const VehicleState* drawn_at(std::int64_t frame) const;
  void evaluate_frame(std::int64_t frame);

  void stats_once_a_second();
  void write_stats() const;

  Bus bus_;
  const Rig& rig_;
  CockpitConfig config_;
  std::filesystem::path stats_file_;
  StopFlag stop_;
  std::unique_ptr<Source> source_;
  Cockpit cockpit_;
  std::optional<KeptDesign>
      kept_design_;  // in front of cockpit_, where what plays by itself must not change the design
  bool said_design_left_out_ = false;
  bool said_unknown_design_ = false;

  Verbs verbs_;
  ControlDesk desk_;
  bool paused_ = false;
  std::optional<std::uint32_t> wanted_design_;
  bool design_by_hand_ = false;  // somebody has chosen it, beside the source
  std::filesystem::path state_file_;
  std::optional<StateFile> kept_;
  std::int64_t kept_next_ = 0;
  struct Before {  // of the cockpit before this one, whose source plays again
    std::uint64_t light_changes = 0;
    std::uint32_t design_index = 0;
    bool design_by_hand = false;
  };
  std::optional<Before> before_;
  Clock::time_point start_ = Clock::now();
  std::chrono::nanoseconds wait_for_car_{};  ///< then simulated time runs by the wall clock alone
  Clock::time_point next_stats_{};
  Clock::time_point woken_{};  // by the source
  SimTime newest_;
  SimTime car_time_;                     // of its newest message
  WallTime newest_stamp_;                // of all frames decoded
  std::vector<WallTime> unsent_stamps_;  // of frames decoded since the last datagram
  LatencyHistogram latency_;
  LatencyHistogram light_latency_;
  std::uint64_t light_changes_sent_ = 0;
  std::uint64_t turns_ = 0;  ///< of the loop in real time
  bool real_time_ = false;
  Scheduling scheduling_;
  double processor_before_s_ = 0.0;  // processor time that starting up took
};

}  // namespace phare
