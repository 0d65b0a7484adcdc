#include "cockpit_io/switch_logic.h"

#include <algorithm>

namespace phare {

namespace {

bool later(const Moment& a, const Moment& b) {
  return a.sim > b.sim;
}

/// Follows one contact. Returns true when its value has changed.
bool follow(DebouncedControl& control, int contact, const SwitchParams& params, Moment now) {
  if (contact != control.raw) {
    control.raw = contact;
    control.raw_since = now;
  }
  if (control.raw == control.value || now.sim.ns < control.quiet_until_ns) return false;
  control.value = control.raw;
  control.quiet_until_ns = now.sim.ns + params.debounce_ns;
  return true;
}

/// The state table of the header.
Lights lights_of(const SwitchState& s, bool silent) {
  const bool ignition = s.ignition.value != 0;
  const auto stalk = static_cast<LightSwitch>(s.stalk.value);
  const bool low = stalk == LightSwitch::kLow || stalk == LightSwitch::kHigh;
  const bool high = stalk == LightSwitch::kHigh || s.high.value != 0;

  Lights lights;
  lights.design_index = s.lights.design_index;
  if (ignition && silent) {
    lights.light_switch = LightSwitch::kLow;
    return lights;
  }
  if (!ignition) {
    lights.light_switch = stalk == LightSwitch::kPosition ? LightSwitch::kPosition : LightSwitch::kOff;
    return lights;
  }
  lights.light_switch = low && high ? LightSwitch::kHigh : low ? LightSwitch::kLow : stalk;
  lights.flash = s.flash.value != 0;
  lights.fog_front = s.fog_front.value != 0 && lights.light_switch != LightSwitch::kOff;
  return lights;
}

void take_lights(const Lights& lights, Moment cause, SwitchState& state) {
  if (lights == state.lights) return;
  state.lights = lights;
  ++state.light_changes;
  state.light_change = cause;
}

}  // namespace

void advance_switches(const SwitchParams& params, const SwitchInput& input, bool silent, Moment now, SwitchState& s) {
  Moment cause{SimTime{-1}, {}};
  const auto moved = [&](DebouncedControl& control, int contact) {
    if (!follow(control, contact, params, now)) return false;
    if (later(control.raw_since, cause)) cause = control.raw_since;
    return true;
  };

  moved(s.ignition, input.ignition);
  moved(s.stalk, static_cast<int>(input.stalk));
  moved(s.high, input.high);
  moved(s.flash, input.flash);
  moved(s.fog_front, input.fog_front);
  const bool next = moved(s.design_next, input.design_next) && s.design_next.value != 0;
  const bool previous = moved(s.design_previous, input.design_previous) && s.design_previous.value != 0;
  if (silent != s.fail_safe) {
    s.fail_safe = silent;
    cause = now;
  }

  Lights lights = lights_of(s, silent);
  const std::uint32_t designs = std::max(params.design_count, 1u);
  if (next) lights.design_index = (lights.design_index + 1) % designs;
  if (previous) lights.design_index = (lights.design_index + designs - 1) % designs;
  take_lights(lights, cause, s);
}

void choose_design(const SwitchParams& params, std::uint32_t design_index, Moment now, SwitchState& s) {
  Lights lights = s.lights;
  lights.design_index = design_index % std::max(params.design_count, 1u);
  take_lights(lights, now, s);
}

}  // namespace phare
