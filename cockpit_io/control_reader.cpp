#include "cockpit_io/control_reader.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace phare {

namespace {

std::optional<int> level_of(const ControlMapping& mapping, double value) {
  const auto found = std::find_if(mapping.levels.begin(), mapping.levels.end(),
                                  [&](const SignalLevel& level) { return level.when.value == value; });
  return found == mapping.levels.end() ? std::nullopt : std::optional(found->level);
}

/// A pedal or wheel from its range, the dead zone at its released end taken out.
double share_01(const ControlMapping& m, double value) {
  const double share = std::clamp((value - m.lowest) / (m.highest - m.lowest), 0.0, 1.0);
  return std::max(share - m.dead_zone, 0.0) / (1.0 - m.dead_zone);
}

double steering_rad(const ControlMapping& m, double value) {
  const double wheel_deg = value * m.scale + m.offset_deg;
  // Beyond the dead zone the angle is the true one, so that the wheel and the car agree.
  const double live_deg = std::abs(wheel_deg) <= m.dead_zone ? 0.0 : wheel_deg;
  return std::clamp(live_deg, m.lowest, m.highest) * std::numbers::pi / 180.0;
}

std::optional<Contact> contact_of(Control control) {
  switch (control) {
    case Control::kLightSwitch:
    case Control::kPosition:
    case Control::kLow:
      return Contact::kStalk;
    case Control::kHigh:
      return Contact::kHigh;
    case Control::kBeamLever:
      return Contact::kLever;
    case Control::kFlash:
      return Contact::kFlash;
    case Control::kFogFront:
      return Contact::kFogFront;
    case Control::kFogRear:
      return Contact::kFogRear;
    case Control::kTurn:
    case Control::kTurnLeft:
    case Control::kTurnRight:
      return Contact::kTurn;
    case Control::kHazard:
      return Contact::kHazard;
    case Control::kDesignNext:
      return Contact::kDesignNext;
    case Control::kDesignPrevious:
      return Contact::kDesignPrevious;
    case Control::kAutomaticHigh:
      return Contact::kAutomatic;
    case Control::kIgnition:
      return Contact::kIgnition;
    default:
      return std::nullopt;
  }
}

}  // namespace

bool ControlReader::pressed(double value, std::int64_t at_ns) {
  const auto& on = mapping_.on;
  const bool contact =
      mapping_.invert != (on.empty() ? value != 0.0 : std::any_of(on.begin(), on.end(), [&](const NamedValue& v) {
        return v.value == value;
      }));
  // `high` with a latch is a push button that switch logic latches, because low going off has to end it.
  if (mapping_.latch == LatchKind::kNone || mapping_.control == Control::kHigh) return contact;
  if (contact != contact_ && at_ns >= quiet_until_ns_) {
    contact_ = contact;
    quiet_until_ns_ = at_ns + debounce_ns_;
    if (contact) latched_ = !latched_;
  }
  return latched_;
}

bool ControlReader::take(double value, std::int64_t at_ns, BeamBits& bits, DriverInput& input) {
  SwitchInput& switches = input.switches;
  const auto level = level_of(mapping_, value);
  if (!mapping_.levels.empty() && !level) return false;
  switch (mapping_.control) {
    case Control::kLightSwitch:
      switches.stalk = static_cast<LightSwitch>(*level);
      return true;
    case Control::kBeamLever:
      switches.lever = static_cast<Lever>(*level);
      return true;
    case Control::kTurn:
      switches.turn = static_cast<TurnSignal>(*level);
      return true;
    case Control::kGear:
      input.gear = static_cast<Gear>(*level);
      return true;
    case Control::kSteering:
      input.steering_wheel_rad = steering_rad(mapping_, value);
      return true;
    case Control::kAccelerator:
      input.accelerator_01 = share_01(mapping_, value);
      return true;
    case Control::kBrake:
      input.brake_01 = share_01(mapping_, value);
      return true;
    case Control::kClutch:
      input.clutch_01 = share_01(mapping_, value);
      return true;
    case Control::kParkingBrake:
      input.parking_brake_01 = share_01(mapping_, value);
      return true;
    case Control::kLampAim:
      input.lamp_aim_rad = share_01(mapping_, value) * mapping_.lowest_aim_rad;
      return true;
    default:
      break;
  }

  const bool on = pressed(value, at_ns);
  switch (mapping_.control) {
    case Control::kPosition:
      bits.position = on;
      break;
    case Control::kLow:
      bits.low = on;
      break;
    case Control::kHigh:
      if (mapping_.latch == LatchKind::kNone) {
        switches.high = on;
      } else {
        switches.lever = on ? Lever::kPush : Lever::kNeutral;
      }
      break;
    case Control::kFlash:
      switches.flash = on;
      break;
    case Control::kFogFront:
      switches.fog_front = on;
      break;
    case Control::kFogRear:
      switches.fog_rear = on;
      break;
    case Control::kTurnLeft:
      bits.left = on;
      break;
    case Control::kTurnRight:
      bits.right = on;
      break;
    case Control::kHazard:
      switches.hazard = on;
      break;
    case Control::kDesignNext:
      switches.design_next = on;
      break;
    case Control::kDesignPrevious:
      switches.design_previous = on;
      break;
    case Control::kAutomaticHigh:
      switches.automatic = on;
      break;
    case Control::kVehicleAhead:
      switches.ahead = on;
      break;
    case Control::kIgnition:
      switches.ignition = on;
      break;
    default:
      return false;
  }
  return true;
}

void settle_bits(const CockpitConfig& config, const BeamBits& bits, DriverInput& input) {
  if (config.find(Control::kLow) != nullptr || config.find(Control::kPosition) != nullptr) {
    input.switches.stalk = bits.low ? LightSwitch::kLow : bits.position ? LightSwitch::kPosition : LightSwitch::kOff;
  }
  if (config.find(Control::kTurnLeft) != nullptr || config.find(Control::kTurnRight) != nullptr) {
    // Both at once is a car that shows its hazard lamps here.
    input.switches.turn = bits.left == bits.right ? TurnSignal::kNone
                          : bits.left             ? TurnSignal::kLeft
                                                  : TurnSignal::kRight;
  }
}

DriverInput initial_input(const CockpitConfig& config) {
  DriverInput input;
  input.switches.stalk = static_cast<LightSwitch>(config.default_light);
  // A switch that is there has not been seen on yet.
  if (config.find(Control::kAutomaticHigh) != nullptr) input.switches.automatic = false;
  return input;
}

SwitchParams switch_params(const CockpitConfig& config, std::uint32_t design_count) {
  const auto ns = [](double seconds) { return static_cast<std::int64_t>(seconds * 1e9); };
  SwitchParams params;
  params.design_count = design_count;
  // A script has no contacts that bounce.
  params.debounce_ns = config.source == SourceKind::kDriver ? 0 : ns(config.debounce_s);
  params.automatic_high = config.automatic_high;
  params.automatic_above_mps = config.automatic_above_mps;
  params.automatic_below_mps = config.automatic_below_mps;
  params.automatic_delay_ns = ns(config.automatic_delay_s);
  for (const ControlMapping& mapping : config.controls) {
    const auto contact = contact_of(mapping.control);
    if (contact && mapping.debounce_s)
      params.own_debounce_ns[static_cast<std::size_t>(*contact)] = ns(*mapping.debounce_s);
    if (mapping.latch == LatchKind::kNone) continue;
    if (mapping.control == Control::kHigh ||
        (mapping.control == Control::kBeamLever && mapping.latch == LatchKind::kPush))
      params.lever_latch = LeverLatch::kPush;
    if (mapping.control == Control::kBeamLever && mapping.latch == LatchKind::kPull)
      params.lever_latch = LeverLatch::kPull;
  }
  return params;
}

}  // namespace phare
