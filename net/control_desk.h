// Where a process takes its commands: each RigControl is done once, in the order its sender numbered them, and
// answered.
//
// A sender numbers its requests 1, 2, 3 … and sends those that are not answered again, in order, so that a lost
// datagram costs time and no command. Here a request is done when all before it are; one that comes again gets the
// answer it had. A receiver that starts while a sender speaks begins at RigControl.first_open. A request without a
// number is done and not answered. Of each sender the last kWindow answers are kept, of senders those that Bus knows
// (ManyStarts).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "net/bus.h"

namespace phare {

/// Answers in the making; ControlDesk fills in to whom.
ControlReply accepted(std::string now);
ControlReply refused(std::string reason);
ControlReply pending(std::string now);
ControlReply not_mine();

/// "design 7: the rig has 2, counted from 0: 0 \"reflector\", 1 \"matrix\""
std::string no_such_design(const Rig& rig, std::uint32_t index);

/// The processes that do a command. All others answer that it is not theirs.
Roles concerned(const RigControl& control);

/// What a process does with each kind of command: a handler a kind. A kind without one is another process's.
class Verbs {
 public:
  using Command = decltype(RigControl::command);
  static constexpr std::size_t kKinds = std::variant_size_v<Command>;

  /// `handle(const Kind&) -> ControlReply`
  template <typename Kind, typename Handle>
  Verbs& on(Handle handle) {
    handlers_[Command(Kind{}).index()] = [handle = std::move(handle)](const Command& command) {
      return handle(std::get<Kind>(command));
    };
    return *this;
  }

  ControlReply operator()(const RigControl& control) const {
    const auto& handler = handlers_[control.command.index()];
    return handler ? handler(control.command) : not_mine();
  }

 private:
  std::array<std::function<ControlReply(const Command&)>, kKinds> handlers_{};
};

class ControlDesk {
 public:
  /// Most requests that a sender may have on their way.
  static constexpr std::size_t kWindow = 64;

  using Act = std::function<ControlReply(const RigControl&)>;

  /// The answer to send, if any; calls `act` where the request is new. An answer that was pending is asked for again.
  std::optional<ControlReply> take(std::uint64_t start_id, const RigControl& control, const Act& act);

  /// Within Bus::on_datagram: takes the datagram, should it be a RigControl, and answers it. `act` is asked only for
  /// commands that concern the role of this bus. True when it was one.
  bool serve(Bus& bus, const Datagram& datagram, const Act& act);

 private:
  struct Sender {
    std::uint64_t start_id = 0;
    std::uint64_t next = 0;            // request that is done next
    std::deque<ControlReply> answers;  // to the requests before it, the newest last
  };
  Sender& sender(std::uint64_t start_id, std::uint64_t first_open);

  std::vector<Sender> senders_;  // in the order they were heard, the newest last
};

}  // namespace phare
