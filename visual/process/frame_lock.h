// The pictures of one rig in real time: the first channel begins each frame for all, so that no two show different
// moments. It says which (FrameStart: time, controls, pose), and begins the next when all have drawn that one. Lockstep
// has a barrier of its own (net/lockstep.h), and a rig with one channel needs none: then nothing is sent, nothing
// waits.
//
// Who is silent holds nobody up: the first channel waits kWait for a picture that answers slowly, and then not at all
// until it has spoken again; the others draw by their own clocks once the first has been silent for kAlone, or,
// where another beam is wanted than they show, for kBeam. All of it is counted. What a control
// law answers, and the desk, each channel takes as it hears it, which may be a frame apart. Checked by
// tests/visual_process/frame_lock_test.cpp.
#pragma once

#include <chrono>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "net/bus.h"
#include "net/messages.h"

namespace phare {

class FrameLock {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kWait{250}, kBeam{250}, kAlone{2000}, kAgain{20};

  /// `channels`: of the rig.
  FrameLock(std::uint32_t channel, std::uint32_t channels, bool lockstep)
      : channel_(channel), on_(channels > 1 && !lockstep) {}

  /// This channel begins frames for others.
  bool leads() const { return on_ && channel_ == 0; }
  /// It draws what the first begins. False, too, while the first is silent. `beam_differs`: what is shown is not what
  /// the controls want by now.
  bool follows(const Bus& bus, bool beam_differs, Clock::time_point now);

  /// First channel, often: whether the next frame may begin. Asks again who does not answer.
  bool may_begin(Bus& bus, Clock::time_point now);
  /// First channel: tells the others. They draw while it does.
  void begin(Bus& bus, SimTime time, FrameStart start, Clock::time_point now);

  /// Others: the frame to draw; nothing: not yet. Answers once more where the answer to the last was lost.
  struct Begun {
    SimTime time;
    FrameStart start;
  };
  std::optional<Begun> next(Bus& bus);
  /// Others: a frame was drawn by the own clock.
  void drew_alone() { number_ = 0, ++alone_; }

  /// For FrameReport::start.
  std::uint64_t number() const { return number_; }

  /// {"together", "apart"} of the first: frames that all had drawn before the next began, and others; {"together",
  /// "alone"} of another. Null where nothing is locked.
  nlohmann::json json() const;

 private:
  std::uint32_t channel_;
  bool on_;
  std::uint64_t number_ = 0;  // of the frame that was begun last and is not judged yet; 0: none
  std::uint64_t begun_count_ = 0;
  Clock::time_point begun_{}, told_{};
  std::vector<Clock::time_point> silent_;  // by channel: when the last was heard of one who was waited for in vain
  std::uint64_t together_ = 0, apart_ = 0, alone_ = 0;
};

}  // namespace phare
