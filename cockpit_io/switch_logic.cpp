#include "cockpit_io/switch_logic.h"

#include <algorithm>

namespace phare {

namespace {

constexpr std::int64_t kFlashPeriod_ns = 60'000'000'000 / 90;  // UN R48 6.5.9: 90 ± 30 a minute

bool later(const Moment& a, const Moment& b) {
  return a.sim > b.sim;
}

DebouncedControl& contact_of(SwitchState& s, Contact contact) {
  return s.contacts[static_cast<std::size_t>(contact)];
}

bool is_on(const SwitchState& s, Contact contact) {
  return s.contacts[static_cast<std::size_t>(contact)].value != 0;
}

/// Follows one contact. Returns true when its value has changed.
bool follow(DebouncedControl& control, int contact, std::int64_t debounce_ns, Moment now) {
  if (contact != control.raw) {
    control.raw = contact;
    control.raw_since = now;
  }
  if (control.raw == control.value || now.sim.ns < control.quiet_until_ns) return false;
  control.value = control.raw;
  control.quiet_until_ns = now.sim.ns + debounce_ns;
  return true;
}

/// The first state table of the header.
Lights lights_of(const SwitchState& s, bool silent) {
  const auto stalk = static_cast<LightSwitch>(s.contacts[static_cast<std::size_t>(Contact::kStalk)].value);
  const bool low = stalk == LightSwitch::kLow || stalk == LightSwitch::kHigh;
  const bool high = stalk == LightSwitch::kHigh || is_on(s, Contact::kHigh) || s.lever_high || s.automatic_high;

  Lights lights;
  lights.design_index = s.lights.design_index;
  if (!is_on(s, Contact::kIgnition)) {
    lights.light_switch = stalk == LightSwitch::kPosition ? LightSwitch::kPosition : LightSwitch::kOff;
    return lights;
  }
  if (silent) {
    lights.light_switch = LightSwitch::kLow;
    return lights;
  }
  lights.light_switch = low && high ? LightSwitch::kHigh : low ? LightSwitch::kLow : stalk;
  lights.flash = is_on(s, Contact::kFlash) || s.lever_flash;
  lights.fog_front = is_on(s, Contact::kFogFront) && lights.light_switch != LightSwitch::kOff;
  return lights;
}

/// What moved in this call.
struct Edges {
  bool flash = false, automatic = false, stalk = false, fog_rear = false, lever = false;
};

/// The table of the beam lever.
void advance_lever(LeverLatch latch, const Edges& moved, bool silent, SwitchState& s) {
  const auto stalk = static_cast<LightSwitch>(contact_of(s, Contact::kStalk).value);
  const bool low = stalk >= LightSwitch::kLow && is_on(s, Contact::kIgnition) && !silent;
  const auto lever = static_cast<Lever>(contact_of(s, Contact::kLever).value);
  if (!low) s.lever_high = false;
  if (latch == LeverLatch::kStays) {
    s.lever_high = low && lever == Lever::kPush;
    s.lever_flash = lever == Lever::kPull || lever == Lever::kHalf;
    return;
  }
  if (!moved.lever) {
    if (lever == Lever::kNeutral) s.lever_flash = false;
    return;
  }
  const bool was_high = s.lever_high;
  s.lever_flash = lever == Lever::kHalf;
  if (lever == Lever::kPush && low) s.lever_high = latch == LeverLatch::kPull || !was_high;
  if (lever == Lever::kPull && latch == LeverLatch::kPush) {
    s.lever_high = false;
    s.lever_flash = !was_high;
  }
  if (lever == Lever::kPull && latch == LeverLatch::kPull) {
    s.lever_high = low && !was_high;
    s.lever_flash = !low;
  }
}

/// Whether the automatic has high beam on: the third table.
void advance_automatic(const SwitchParams& params, const SwitchInput& input, const Edges& moved, bool silent,
                       double speed_mps, Moment now, SwitchState& s) {
  if (input.ahead != s.ahead) {
    s.ahead = input.ahead;
    s.clear_since_ns = now.sim.ns;
  }
  const auto stalk = static_cast<LightSwitch>(contact_of(s, Contact::kStalk).value);
  if (moved.stalk && stalk == LightSwitch::kLow) s.automatic_asleep = false;
  if (moved.automatic && is_on(s, Contact::kAutomatic)) s.automatic_asleep = false;
  const bool flash_pulled = (moved.flash && is_on(s, Contact::kFlash)) || (moved.lever && s.lever_flash);
  if (flash_pulled && s.automatic_high) s.automatic_asleep = true;
  s.signals.automatic_armed = params.automatic_high && is_on(s, Contact::kAutomatic) && !s.automatic_asleep &&
                              stalk == LightSwitch::kLow && is_on(s, Contact::kIgnition) && !silent;
  if (!s.signals.automatic_armed || s.ahead || speed_mps < params.automatic_below_mps) {
    s.automatic_high = false;
  } else if (now.sim.ns - s.clear_since_ns >= params.automatic_delay_ns && speed_mps >= params.automatic_above_mps) {
    s.automatic_high = true;
  }
}

/// The second table, turn and hazard. `lights`: those of this call.
void advance_signals(const Lights& lights, const Edges& moved, bool silent, Moment now, SwitchState& s) {
  const bool alive = is_on(s, Contact::kIgnition) && !silent;
  const bool position = lights.light_switch != LightSwitch::kOff;
  if (moved.fog_rear) s.fog_rear_wanted = is_on(s, Contact::kFogRear);
  if (!alive || !position) s.fog_rear_wanted = false;
  const bool may_begin = lights.light_switch >= LightSwitch::kLow || lights.fog_front;
  s.signals.fog_rear = s.fog_rear_wanted && (s.signals.fog_rear || may_begin);

  const Signals before = s.signals;
  s.signals.turn = alive ? static_cast<TurnSignal>(contact_of(s, Contact::kTurn).value) : TurnSignal::kNone;
  s.signals.hazard = is_on(s, Contact::kHazard);
  if (s.signals.turn != before.turn || s.signals.hazard != before.hazard) s.flashing_since = now.sim;
}

void take_lights(const Lights& lights, Moment cause, SwitchState& state) {
  if (lights == state.lights) return;
  state.lights = lights;
  ++state.light_changes;
  state.light_change = cause;
}

}  // namespace

void advance_switches(const SwitchParams& params, const SwitchInput& input, bool silent, Moment now, SwitchState& s,
                      double speed_mps) {
  Moment cause{SimTime{-1}, {}};
  const auto moved = [&](Contact contact, int reading) {
    DebouncedControl& control = contact_of(s, contact);
    const auto& own_ns = params.own_debounce_ns[static_cast<std::size_t>(contact)];
    if (!follow(control, reading, own_ns.value_or(params.debounce_ns), now)) return false;
    if (later(control.raw_since, cause)) cause = control.raw_since;
    return true;
  };

  Edges edges;
  moved(Contact::kIgnition, input.ignition);
  edges.stalk = moved(Contact::kStalk, static_cast<int>(input.stalk));
  moved(Contact::kHigh, input.high);
  edges.flash = moved(Contact::kFlash, input.flash);
  moved(Contact::kFogFront, input.fog_front);
  const bool next = moved(Contact::kDesignNext, input.design_next) && is_on(s, Contact::kDesignNext);
  const bool previous = moved(Contact::kDesignPrevious, input.design_previous) && is_on(s, Contact::kDesignPrevious);
  edges.fog_rear = moved(Contact::kFogRear, input.fog_rear);
  moved(Contact::kTurn, static_cast<int>(input.turn));
  moved(Contact::kHazard, input.hazard);
  edges.automatic = moved(Contact::kAutomatic, input.automatic);
  edges.lever = moved(Contact::kLever, static_cast<int>(input.lever));
  if (silent != s.fail_safe) {
    s.fail_safe = silent;
    cause = now;
  }
  const bool automatic_before = s.automatic_high;
  advance_lever(params.lever_latch, edges, silent, s);
  advance_automatic(params, input, edges, silent, speed_mps, now, s);
  if (s.automatic_high != automatic_before && cause.sim.ns < 0) cause = now;

  Lights lights = lights_of(s, silent);
  const std::uint32_t designs = std::max(params.design_count, 1u);
  if (next) lights.design_index = (lights.design_index + 1) % designs;
  if (previous) lights.design_index = (lights.design_index + designs - 1) % designs;
  advance_signals(lights, edges, silent, now, s);
  take_lights(lights, cause, s);
}

void choose_design(const SwitchParams& params, std::uint32_t design_index, Moment now, SwitchState& s) {
  if (design_index >= std::max(params.design_count, 1u)) return;
  Lights lights = s.lights;
  lights.design_index = design_index;
  take_lights(lights, now, s);
}

Telltales telltales(const SwitchState& s, SimTime now) {
  const bool lit = (now.ns - s.flashing_since.ns) % kFlashPeriod_ns < kFlashPeriod_ns / 2;
  const LightSwitch light = s.lights.light_switch;
  Telltales t;
  t.high_beam = light == LightSwitch::kHigh || s.lights.flash;
  t.low_beam = light == LightSwitch::kLow || light == LightSwitch::kHigh;
  t.position = light != LightSwitch::kOff;
  t.fog_front = s.lights.fog_front;
  t.fog_rear = s.signals.fog_rear;
  t.turn_left = lit && (s.signals.hazard || s.signals.turn == TurnSignal::kLeft);
  t.turn_right = lit && (s.signals.hazard || s.signals.turn == TurnSignal::kRight);
  t.hazard = lit && s.signals.hazard;
  t.automatic_high = s.signals.automatic_armed;
  t.fail_safe = s.fail_safe;
  return t;
}

}  // namespace phare
