#include "net/silence.h"

#include <cstdio>

namespace phare {

bool is_silent(std::chrono::nanoseconds silence) {
  return silence > channel_of<CockpitState>().stale_after;
}

CockpitState after_silence(CockpitState controls, std::chrono::nanoseconds silence) {
  if (!is_silent(silence)) return controls;
  controls.light_switch = LightSwitch::kLow;
  controls.flash = false;
  controls.fog_front = false;
  controls.fog_rear = false;
  controls.turn = TurnSignal::kNone;
  controls.high_beam_automatic = false;
  controls.fail_safe = true;
  char text[64];
  std::snprintf(text, sizeof text, "no cockpit for %.1f s: low beam", std::chrono::duration<double>(silence).count());
  controls.source_fault = text;
  return controls;
}

CockpitState controls_to_show(const Bus& bus, std::chrono::steady_clock::time_point now) {
  if (const auto* newest = bus.newest<CockpitState>()) return after_silence(newest->value, now - newest->heard);
  CockpitState controls;
  controls.light_switch = LightSwitch::kLow;
  controls.fail_safe = true;
  controls.source_fault = "no cockpit yet: low beam";
  return controls;
}

}  // namespace phare
