// The other end of net/control_desk.h: sends commands to a running rig, again until they are answered, and tells in
// order what came of each.
//
// A command is answered when every process that it concerns has answered. Up to ControlDesk::kWindow are on their way
// at a time; after a change of design the next waits until it shines, for it may speak of a lamp of that design.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "net/control_desk.h"

namespace phare {

class ControlClient {
 public:
  using Clock = std::chrono::steady_clock;

  enum class Outcome { kDone, kRefused, kSilent };
  struct Answer {
    Outcome outcome = Outcome::kDone;
    std::string text;  ///< what holds now, or the reason
  };

  /// `wait`: how long a command that was sent may stay without an answer, and a design that is accepted without light.
  ControlClient(Bus bus, const Rig& rig, std::chrono::nanoseconds wait);
  ControlClient(const ControlClient&) = delete;
  ControlClient& operator=(const ControlClient&) = delete;

  bool full() const { return open_.size() >= ControlDesk::kWindow; }
  bool idle() const { return open_.empty(); }
  int fd() const { return bus_.fd(); }

  void put(const RigControl& control);
  /// Takes the place of a command that cannot be sent, so that answers stay in order.
  void put_refused(std::string reason);

  /// Sends, receives, repeats; returns at once.
  void step();
  /// The oldest answer that has not been given yet, once it is there.
  std::optional<Answer> next();
  /// Sleeps in step() until next().
  Answer wait_for_next();

 private:
  struct Open {
    RigControl control;
    std::optional<Clock::time_point> sent;      // first time; not yet: nullopt
    std::map<std::string, ControlReply> heard;  // by process
    std::optional<Answer> answer;
  };
  void hear(const Datagram& datagram);
  void settle(Open& open) const;
  std::string silence(const Open& open) const;

  Bus bus_;
  std::string address_;
  std::chrono::nanoseconds wait_;
  std::deque<Open> open_;
  std::uint64_t next_id_ = 1;
  std::set<std::string> alive_;  // processes that have answered anything
  Clock::time_point repeat_{};
};

}  // namespace phare
