#include "tools/control_client.h"

#include <algorithm>
#include <utility>
#include <variant>

namespace phare {
namespace {

using namespace std::chrono_literals;

constexpr auto kRepeatEvery = 100ms;

std::string process_name(const Datagram& datagram) {
  switch (datagram.sender) {
    case Sender::kCockpit:
      return "cockpit";
    case Sender::kDynamics:
      return "dynamics";
    default:
      return "visual-" + std::to_string(datagram.sender_channel);
  }
}

std::set<std::string> processes_of(Roles roles, std::uint32_t channels) {
  std::set<std::string> names;
  if (roles.has(Role::kCockpit)) names.insert("cockpit");
  if (roles.has(Role::kDynamics)) names.insert("dynamics");
  for (std::uint32_t channel = 0; roles.has(Role::kVisual) && channel < channels; ++channel)
    names.insert("visual-" + std::to_string(channel));
  return names;
}

std::string joined(const std::set<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

ControlClient::ControlClient(Bus bus, const Rig& rig, std::chrono::nanoseconds wait)
    : bus_(std::move(bus)), address_(rig.bind_address + ":" + std::to_string(rig.port_base)), wait_(wait) {
  bus_.on_datagram = [this](const Datagram& datagram, std::span<const std::byte>) { hear(datagram); };
}

void ControlClient::put(const RigControl& control) {
  open_.push_back({control, std::nullopt, {}, std::nullopt});
  open_.back().control.request_id = next_id_++;
}

void ControlClient::put_refused(std::string reason) {
  open_.push_back({{}, std::nullopt, {}, Answer{Outcome::kRefused, std::move(reason)}});
}

void ControlClient::hear(const Datagram& datagram) {
  const auto* reply = std::get_if<ControlReply>(&datagram.payload);
  if (reply == nullptr || reply->to_start_id != bus_.start_id()) return;
  const std::string process = process_name(datagram);
  alive_.insert(process);
  for (Open& open : open_)
    if (open.control.request_id == reply->request_id) open.heard[process] = *reply;
}

/// Nobody answers, or not everyone.
std::string ControlClient::silence(const Open& open) const {
  if (alive_.empty()) return "no rig answers on " + address_ + "; is one running?";
  std::set<std::string> silent;
  for (const std::string& name : processes_of(concerned(open.control), bus_.channels()))
    if (!open.heard.contains(name)) silent.insert(name);
  return joined(silent) + " on " + address_ + (silent.size() > 1 ? " do" : " does") + " not answer (" + joined(alive_) +
         (alive_.size() > 1 ? " do)" : " does)") + "; what was sent may still take effect";
}

void ControlClient::settle(Open& open) const {
  if (open.answer || !open.sent) return;
  std::string now, waits, reason;
  std::set<std::string> done;
  bool missing = false;
  const std::set<std::string> concerns = processes_of(concerned(open.control), bus_.channels());
  const bool tells = std::holds_alternative<RigControl::Tell>(open.control.command);
  for (const std::string& name : concerns) {
    const auto found = open.heard.find(name);
    if (found == open.heard.end()) {
      missing = true;
      continue;
    }
    const ControlReply& reply = found->second;
    if (reply.verdict == Verdict::kAccepted) done.insert(name);
    if (reply.verdict == Verdict::kRefused) {
      if (reason.empty()) reason = reply.reason;
    } else if (reply.verdict == Verdict::kPending) {
      waits = name + " shows " + reply.now;
    } else if (tells) {
      now += (now.empty() ? "" : "\n") + name + ": " + reply.now;
    } else if (!reply.now.empty() && now.find(reply.now) == std::string::npos) {
      now += (now.empty() ? "" : "; ") + reply.now;
    }
  }
  const auto waited = Clock::now() - *open.sent;
  if (!reason.empty()) {
    // What some refuse others may have done, who have not answered yet.
    if (missing && waited <= wait_) return;
    open.answer =
        Answer{Outcome::kRefused, done.empty() ? reason : reason + "; done by " + joined(done) + " all the same"};
  } else if (missing) {
    if (waited > wait_) open.answer = Answer{Outcome::kSilent, silence(open)};
  } else if (waits.empty()) {
    open.answer = Answer{Outcome::kDone, now};
  } else if (waited > wait_) {  // a paused rig
    open.answer = Answer{Outcome::kDone, "accepted; " + waits};
  }
}

void ControlClient::step() {
  bus_.poll();
  for (Open& open : open_) settle(open);
  const auto now = Clock::now();
  const bool repeat = now >= repeat_;
  const auto oldest = std::ranges::find_if(open_, [](const Open& open) { return !open.answer; });
  for (auto open = oldest; open != open_.end(); ++open) {
    if (open->answer) continue;
    if (open->control.request_id >= oldest->control.request_id + ControlDesk::kWindow) break;
    if (!open->sent || repeat) {
      open->control.first_open = oldest->control.request_id;
      bus_.send(SimTime{}, open->control);
      if (!open->sent) open->sent = now;
      repeat_ = now + kRepeatEvery;
    }
    if (std::holds_alternative<RigControl::Design>(open->control.command)) break;
  }
}

std::optional<ControlClient::Answer> ControlClient::next() {
  if (open_.empty() || !open_.front().answer) return std::nullopt;
  Answer answer = std::move(*open_.front().answer);
  open_.pop_front();
  return answer;
}

ControlClient::Answer ControlClient::wait_for_next() {
  while (true) {
    step();
    if (auto answer = next()) return *answer;
    bus_.wait(20ms);
  }
}

}  // namespace phare
