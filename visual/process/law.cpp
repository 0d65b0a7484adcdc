#include "visual/process/law.h"

#include <spdlog/spdlog.h>

#include <algorithm>

#include "net/channels.h"

namespace phare {

CockpitState with_beam_of(const LawAnswer& answer, CockpitState controls) {
  if (answer.light_switch != LightSwitch::kOff && controls.light_switch >= LightSwitch::kLow)
    controls.light_switch = answer.light_switch;
  return controls;
}

CockpitState without_law(CockpitState controls) {
  controls.light_switch = std::min(controls.light_switch, LightSwitch::kLow);
  controls.fail_safe = true;
  if (controls.source_fault.empty()) controls.source_fault = "the control law is silent: low beam";
  return controls;
}

bool LawLink::has_answered(const Bus& bus, std::int64_t frame) {
  const auto* answer = bus.newest<LawAnswer>();
  return answer != nullptr && answer->value.frame_index == frame;
}

void LawLink::waits_for(std::int64_t frame) {
  constexpr std::chrono::seconds kSaidAfter(5);
  const auto now = std::chrono::steady_clock::now();
  if (frame != waits_for_) waits_for_ = frame, waits_since_ = now;
  if (now - waits_since_ < kSaidAfter) return;
  spdlog::warn("frame {} waits for the control law's answer", frame);
  waits_since_ = std::chrono::steady_clock::time_point::max();
}

CockpitState LawLink::lead(const Bus& bus, Lamps& lamps, const CockpitState& controls, std::chrono::nanoseconds period,
                           bool waits) {
  const auto* answer = bus.newest<LawAnswer>();
  const bool silent = answer == nullptr || (!waits && std::chrono::steady_clock::now() - answer->heard >
                                                          channel_of<LawAnswer>().stale_after);
  if (silent != silent_ && silent) spdlog::warn("the control law is silent: low beam, lamps straight");
  if (silent != silent_ && !silent) spdlog::info("the control law is back");
  silent_ = silent;
  if (silent) {
    ++silent_frames_;
    static_cast<void>(lamps.follow(LawAnswer{}, controls.design_index));
    return without_law(controls);
  }
  take(*answer, period);
  if (const Status followed = lamps.follow(answer->value, controls.design_index); !followed) {
    if (followed.error().text() != why_)
      spdlog::warn("the control law's answer is not followed: {}", followed.error().text());
    why_ = followed.error().text();
    ++refused_;
  }
  return with_beam_of(answer->value, controls);
}

void LawLink::take(const Newest<LawAnswer>& answer, std::chrono::nanoseconds period) {
  if (answer.sent == sent_) return;
  sent_ = answer.sent;
  const auto delay_ns = answer.received.ns - answer.value.input.ns;
  if (delay_ns <= period.count()) ++in_frame_;
  delay_ms_.add(static_cast<double>(delay_ns) * 1e-6);
}

nlohmann::json LawLink::json() const {
  nlohmann::json json{{"answers", delay_ms_.count()},
                      {"in_frame", in_frame_},
                      {"delay_ms", to_json(delay_ms_)},
                      {"silent_frames", silent_frames_},
                      {"refused", refused_}};
  if (!why_.empty()) json["why"] = why_;
  return json;
}

}  // namespace phare
