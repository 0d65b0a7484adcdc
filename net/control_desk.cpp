#include "net/control_desk.h"

#include <algorithm>
#include <utility>
#include <variant>

namespace phare {

ControlReply accepted(std::string now) {
  return {0, 0, Verdict::kAccepted, {}, std::move(now)};
}
ControlReply refused(std::string reason) {
  return {0, 0, Verdict::kRefused, std::move(reason), {}};
}
ControlReply pending(std::string now) {
  return {0, 0, Verdict::kPending, {}, std::move(now)};
}
ControlReply not_mine() {
  return {0, 0, Verdict::kNotMine, {}, {}};
}

std::string no_such_design(const Rig& rig, std::uint32_t index) {
  std::string text =
      "design " + std::to_string(index) + ": the rig has " + std::to_string(rig.designs.size()) + ", counted from 0";
  for (std::size_t i = 0; i < rig.designs.size() && i < 10; ++i)
    text += (i == 0 ? ": " : ", ") + std::to_string(i) + " \"" + rig.designs[i].name + "\"";
  return text;
}

namespace {

const Roles kVisual(Role::kVisual), kClock(Role::kCockpit, Role::kDynamics),
    kEveryone(Role::kCockpit, Role::kDynamics, Role::kVisual);

/// In the order of the alternatives of RigControl::command.
const std::array<Roles, Verbs::kKinds> kConcerned{
    kClock,                                // Pause
    kClock,                                // Seek
    Roles(Role::kCockpit, Role::kVisual),  // Design
    kVisual,                               // Aim
    kEveryone,                             // Quit
    kVisual,                               // Dim
    kVisual,                               // Swivel
    kVisual,                               // Place
    kEveryone,                             // Tell
    kVisual,                               // Set
    kVisual,                               // Mount
    kVisual,                               // Undo
    kVisual,                               // Reset
    kVisual,                               // Save
    kVisual,                               // Frame
};

}  // namespace

Roles concerned(const RigControl& control) {
  return kConcerned[control.command.index()];
}

ControlDesk::Sender& ControlDesk::sender(std::uint64_t start_id, std::uint64_t first_open) {
  const auto known = std::ranges::find(senders_, start_id, &Sender::start_id);
  if (known == senders_.end()) {
    if (senders_.size() == ManyStarts::kMost) senders_.erase(senders_.begin());
    senders_.push_back({start_id, first_open, {}});
  } else {
    std::rotate(known, known + 1, senders_.end());
  }
  return senders_.back();
}

std::optional<ControlReply> ControlDesk::take(std::uint64_t start_id, const RigControl& control, const Act& act) {
  if (control.request_id == 0) {
    act(control);
    return std::nullopt;
  }
  const auto addressed = [&](ControlReply reply) {
    reply.to_start_id = start_id;
    reply.request_id = control.request_id;
    return reply;
  };
  Sender& from = sender(start_id, control.first_open);
  // What its sender has given up waiting for is not waited for here.
  if (control.first_open > from.next) {
    from.next = control.first_open;
    from.answers.clear();
  }
  if (control.request_id > from.next) return std::nullopt;  // one before it is missing and will come again
  if (control.request_id == from.next) {
    from.answers.push_back(addressed(act(control)));
    if (from.answers.size() > kWindow) from.answers.pop_front();
    ++from.next;
    return from.answers.back();
  }
  const std::uint64_t back = from.next - control.request_id;  // 1: the newest answer
  if (back > from.answers.size()) return std::nullopt;
  ControlReply& answer = from.answers[from.answers.size() - back];
  if (answer.verdict == Verdict::kPending) answer = addressed(act(control));
  return answer;
}

bool ControlDesk::serve(Bus& bus, const Datagram& datagram, const Act& act) {
  const auto* control = std::get_if<RigControl>(&datagram.payload);
  if (control == nullptr) return false;
  const Act of_our_role = [&](const RigControl& command) {
    return concerned(command).has(bus.role()) ? act(command) : not_mine();
  };
  if (const auto answer = take(datagram.start_id, *control, of_our_role)) bus.answer(datagram.sim_time, *answer);
  return true;
}

}  // namespace phare
