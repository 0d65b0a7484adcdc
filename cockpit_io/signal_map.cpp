#include "cockpit_io/signal_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "config/toml_table.h"

namespace phare {

namespace {

/// The index of a named signal, or the Error that says why there is none.
Result<std::size_t> find_signal(const Dbc& dbc, const DbcMessage& message, const std::string& name,
                                const std::string& place) {
  if (const DbcSignal* found = message.find(name)) return static_cast<std::size_t>(found - message.signals.data());
  for (const DbcProblem& problem : dbc.problems) {
    if (problem.message == message.name && problem.signal == name) {
      return Error{place, "signal \"" + name + "\" cannot be used: " + dbc.file.string() + ":" +
                              std::to_string(problem.line) + ": " + problem.reason};
    }
  }
  std::vector<std::string> names;
  for (const DbcSignal& signal : message.signals) names.push_back(signal.name);
  return Error{place, unknown_name_reason("signal", name, names) + " (in message " + message.name + " of " +
                          dbc.file.filename().string() + ")"};
}

Result<std::size_t> find_message(const Dbc& dbc, const std::string& name, const std::string& place) {
  if (const DbcMessage* found = dbc.find(name)) return static_cast<std::size_t>(found - dbc.messages.data());
  for (const DbcProblem& problem : dbc.problems) {
    if (problem.message == name && problem.signal.empty()) {
      return Error{place, "message \"" + name + "\" cannot be used: " + dbc.file.string() + ":" +
                              std::to_string(problem.line) + ": " + problem.reason};
    }
  }
  std::vector<std::string> names;
  for (const DbcMessage& message : dbc.messages) names.push_back(message.name);
  std::string reason = "no message \"" + name + "\" in " + dbc.file.filename().string();
  if (const std::string nearest = nearest_name(name, names); !nearest.empty())
    reason += "; did you mean \"" + nearest + "\"?";
  return Error{place, reason};
}

}  // namespace

Result<SignalMap> SignalMap::bind(const CockpitConfig& config, Dbc dbc, std::int64_t start_ns) {
  SignalMap map;
  map.dbc_ = std::move(dbc);
  for (const ControlMapping& mapping : config.controls) {
    const auto message = find_message(map.dbc_, mapping.message, mapping.message_place);
    if (!message) return message.error();
    const DbcMessage& dbc_message = map.dbc_.messages[*message];
    BoundControl control{mapping, 0, std::nullopt};
    const auto signal = find_signal(map.dbc_, dbc_message, mapping.signal, mapping.signal_place);
    if (!signal) return signal.error();
    control.signal = *signal;
    if (!mapping.fine_signal.empty()) {
      const auto fine = find_signal(map.dbc_, dbc_message, mapping.fine_signal, mapping.place);
      if (!fine) return fine.error();
      control.fine_signal = *fine;
    }
    map.beam_bits_ |= mapping.control == Control::kPosition || mapping.control == Control::kLow;

    auto bound =
        std::find_if(map.messages_.begin(), map.messages_.end(), [&](const auto& m) { return m.message == *message; });
    if (bound == map.messages_.end()) {
      bound = map.messages_.insert(bound, BoundMessage{*message, {}, 0, start_ns});
    }
    bound->timeout_ns = std::max(bound->timeout_ns, static_cast<std::int64_t>(mapping.timeout_s * 1e9));
    bound->controls.push_back(std::move(control));
  }
  return map;
}

bool SignalMap::knows(const CanFrame& frame) const {
  return dbc_.find(frame.id, frame.extended) != nullptr;
}

SignalMap::Taken SignalMap::take(const CanFrame& frame, std::int64_t at_ns, DriverInput& input) {
  if (!frame.carries_data()) return Taken::kNotMapped;
  const auto bound = std::find_if(messages_.begin(), messages_.end(), [&](const BoundMessage& m) {
    const DbcMessage& message = dbc_.messages[m.message];
    return message.id == frame.id && message.extended == frame.extended;
  });
  if (bound == messages_.end()) return Taken::kNotMapped;
  bool complete = true;
  for (const BoundControl& control : bound->controls) {
    complete = read(control, dbc_.messages[bound->message], frame, input) && complete;
  }
  if (beam_bits_) settle_beam_bits(input);
  // A frame too short to read does not prove that the stalk is there.
  if (complete) bound->last_ns = std::max(bound->last_ns, at_ns);
  return complete ? Taken::kDecoded : Taken::kIncomplete;
}

bool SignalMap::read(const BoundControl& control, const DbcMessage& message, const CanFrame& frame,
                     DriverInput& input) {
  const ControlMapping& m = control.mapping;
  const auto decoded = decode(message, message.signals[control.signal], frame);
  if (!decoded) return false;
  double value = *decoded;
  if (control.fine_signal) {
    const auto fine = decode(message, message.signals[*control.fine_signal], frame);
    if (!fine) return false;
    value += *fine;
  }

  const auto level = [&]() -> std::optional<int> {
    const auto found = std::find_if(m.levels.begin(), m.levels.end(), [&](const auto& l) { return l.first == value; });
    return found == m.levels.end() ? std::nullopt : std::optional(found->second);
  };
  const bool pressed = m.on ? value == *m.on : value != 0.0;
  const double pedal_01 = std::clamp((value - m.lowest) / (m.highest - m.lowest), 0.0, 1.0);
  switch (m.control) {
    case Control::kLightSwitch:
      if (!level()) return false;
      input.switches.stalk = static_cast<LightSwitch>(*level());
      break;
    case Control::kGear:
      if (!level()) return false;
      input.gear = static_cast<Gear>(*level());
      break;
    case Control::kPosition:
      position_bit_ = pressed;
      break;
    case Control::kLow:
      low_bit_ = pressed;
      break;
    case Control::kHigh:
      input.switches.high = pressed;
      break;
    case Control::kFlash:
      input.switches.flash = pressed;
      break;
    case Control::kFogFront:
      input.switches.fog_front = pressed;
      break;
    case Control::kDesignNext:
      input.switches.design_next = pressed;
      break;
    case Control::kDesignPrevious:
      input.switches.design_previous = pressed;
      break;
    case Control::kIgnition:
      input.switches.ignition = pressed;
      break;
    case Control::kSteering: {
      const double wheel_deg = std::clamp(value * m.scale + m.offset_deg, m.lowest, m.highest);
      input.steering_wheel_rad = wheel_deg * std::numbers::pi / 180.0;
      break;
    }
    case Control::kAccelerator:
      input.accelerator_01 = pedal_01;
      break;
    case Control::kBrake:
      input.brake_01 = pedal_01;
      break;
  }
  return true;
}

void SignalMap::settle_beam_bits(DriverInput& input) const {
  input.switches.stalk = low_bit_ ? LightSwitch::kLow : position_bit_ ? LightSwitch::kPosition : LightSwitch::kOff;
}

std::int64_t SignalMap::silent_at_ns() const {
  std::int64_t first = std::numeric_limits<std::int64_t>::max();
  for (const BoundMessage& message : messages_) first = std::min(first, message.last_ns + message.timeout_ns);
  return first;
}

std::vector<CanId> SignalMap::ids() const {
  std::vector<CanId> ids;
  for (const BoundMessage& m : messages_)
    ids.push_back({dbc_.messages[m.message].id, dbc_.messages[m.message].extended});
  return ids;
}

}  // namespace phare
