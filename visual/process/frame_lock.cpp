#include "visual/process/frame_lock.h"

#include <utility>

namespace phare {

bool FrameLock::follows(const Bus& bus, bool beam_differs, Clock::time_point now) {
  if (!on_ || channel_ == 0) return false;
  if (const auto* start = bus.newest<FrameStart>()) return now - start->heard < (beam_differs ? kBeam : kAlone);
  // Before the first: there is nothing to draw yet, or the first channel is about to begin.
  if (bus.newest<VehicleState>() == nullptr) return true;
  if (begun_ == Clock::time_point{}) begun_ = now;
  return now - begun_ < kAlone;
}

bool FrameLock::may_begin(Bus& bus, Clock::time_point now) {
  if (!leads() || number_ == 0) return true;
  silent_.resize(bus.channels());
  bool all = true, waits = false;
  for (std::uint32_t channel = 1; channel < bus.channels(); ++channel) {
    const auto* report = bus.newest<FrameReport>(channel);
    if (report != nullptr && report->value.start == number_) {
      silent_[channel] = {};
      continue;
    }
    all = false;
    // Who is not up, or has said nothing since he was given up, is not waited for.
    waits = waits || (report != nullptr && report->heard != silent_[channel]);
  }
  if (waits && now - begun_ < kWait) {
    if (now - told_ >= kAgain) bus.send_again(kPayloadIndex<FrameStart>), told_ = now;
    return false;
  }
  for (std::uint32_t channel = 1; channel < bus.channels(); ++channel) {
    const auto* report = bus.newest<FrameReport>(channel);
    if (report != nullptr && report->value.start != number_) silent_[channel] = report->heard;
  }
  ++(all ? together_ : apart_);
  number_ = 0;  // counted
  return true;
}

void FrameLock::begin(Bus& bus, SimTime time, FrameStart start, Clock::time_point now) {
  if (!leads()) return;
  start.number = number_ = ++begun_count_;
  bus.send(time, start);
  begun_ = told_ = now;
}

std::optional<FrameLock::Begun> FrameLock::next(Bus& bus) {
  const auto start = bus.take<FrameStart>();
  if (!start) return std::nullopt;
  if (start->value.number == number_) {
    bus.send_again(kPayloadIndex<FrameReport>);
    return std::nullopt;
  }
  number_ = start->value.number;
  ++together_;
  return Begun{start->sim_time, start->value};
}

nlohmann::json FrameLock::json() const {
  if (!on_) return nullptr;
  if (channel_ == 0) return {{"together", together_}, {"apart", apart_}};
  return {{"together", together_}, {"alone", alone_}};
}

}  // namespace phare
