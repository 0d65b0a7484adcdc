#include "cockpit_io/feedback.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace phare {

namespace {

double number(bool on) {
  return on ? 1.0 : 0.0;
}

double value_of(SendValue value, const FeedbackValues& v) {
  const Telltales& t = v.telltales;
  switch (value) {
    case SendValue::kHighBeam:
      return number(t.high_beam);
    case SendValue::kLowBeam:
      return number(t.low_beam);
    case SendValue::kPosition:
      return number(t.position);
    case SendValue::kFogFront:
      return number(t.fog_front);
    case SendValue::kFogRear:
      return number(t.fog_rear);
    case SendValue::kTurnLeft:
      return number(t.turn_left);
    case SendValue::kTurnRight:
      return number(t.turn_right);
    case SendValue::kHazard:
      return number(t.hazard);
    case SendValue::kAutomaticHigh:
      return number(t.automatic_high);
    case SendValue::kFailSafe:
      return number(t.fail_safe);
    case SendValue::kLightSwitch:
      return static_cast<double>(v.light);
    case SendValue::kDesign:
      return v.design_index;
    case SendValue::kSpeedKmh:
      return v.speed_mps * 3.6;
    case SendValue::kSpeedMps:
      return v.speed_mps;
    case SendValue::kSteeringDeg:
      return v.steering_wheel_rad * 180.0 / std::numbers::pi;
    case SendValue::kOne:
      return 1.0;
  }
  return 0.0;
}

struct Range {
  double lowest = 0.0, highest = 1.0;
};

/// What a source says in a drive. Speeds to a motorway's and the wheel to a turn each way are chosen by eye: a signal
/// that ends before is too small, and one that ends behind may still be.
Range said(SendValue value) {
  switch (value) {
    case SendValue::kLightSwitch:
      return {0.0, 3.0};
    case SendValue::kSpeedKmh:
      return {0.0, 130.0};
    case SendValue::kSpeedMps:
      return {0.0, 36.0};
    case SendValue::kSteeringDeg:
      return {-360.0, 360.0};
    case SendValue::kOne:
      return {1.0, 1.0};
    default:
      return {};  // a telltale; a rig has two designs and more
  }
}

bool has_every_number(const DbcSignal& s) {
  return s.type == DbcSignal::Type::kFloat || s.type == DbcSignal::Type::kDouble;
}

/// What the bits of a whole number hold.
Range held(const DbcSignal& s) {
  const bool is_signed = s.type == DbcSignal::Type::kSigned;
  const double end = std::ldexp(1.0, static_cast<int>(s.length_bits) - (is_signed ? 1 : 0));
  const double first = (is_signed ? -end : 0.0) * s.factor + s.offset;
  const double last = (end - 1.0) * s.factor + s.offset;
  return {std::min(first, last), std::max(first, last)};
}

/// Writes the value, or the nearest that fits: a speed backwards in an unsigned signal is 0.
void write(const DbcMessage& message, const DbcSignal& s, double value, CanFrame& frame) {
  if (encode(message, s, value, frame) || has_every_number(s)) return;
  const Range range = held(s);
  encode(message, s, std::clamp(value, range.lowest, range.highest), frame);
}

/// Why a signal cannot say what its source does; empty: it can.
std::string doubt(const DbcSignal& s, SendValue value) {
  const Range source = said(value);
  const auto span = [](const Range& r) { return physical_text(r.lowest) + " to " + physical_text(r.highest); };
  const auto lacks = [&](const Range& r) {
    const double rounding = 0.5 * std::abs(s.factor);
    return source.lowest < r.lowest - rounding || source.highest > r.highest + rounding;
  };
  const std::string says = std::string(kSendValueNames[static_cast<std::size_t>(value)]) + " is " +
                           (source.lowest < source.highest ? span(source) : physical_text(source.lowest)) + ", ";
  if (!has_every_number(s) && lacks(held(s)))
    return says + "the bits of \"" + s.name + "\" hold " + span(held(s)) + "; beyond, the nearest of these is sent";
  if (const Range written{s.minimum, s.maximum}; s.minimum < s.maximum && lacks(written))
    return says + "the DBC file says that \"" + s.name + "\" is " + span(written);
  return {};
}

/// Whether something a driver would see at once has changed; speed and steering wait for the period.
bool must_not_wait(const FeedbackValues& a, const FeedbackValues& b) {
  return a.telltales != b.telltales || a.light != b.light || a.design_index != b.design_index;
}

}  // namespace

std::vector<std::string> send_doubts(const CockpitConfig& config, const Dbc& dbc) {
  std::vector<std::string> lines;
  for (const SendMessage& send : config.sends) {
    const DbcMessage* message = dbc.find(send.message);
    for (const SendSignal& signal : send.signals) {
      const DbcSignal* found = message == nullptr ? nullptr : message->find(signal.signal);
      const std::string why = found == nullptr ? std::string() : doubt(*found, signal.value);
      if (!why.empty()) lines.push_back(signal.place + ": " + why);
    }
  }
  return lines;
}

Result<Feedback> Feedback::bind(const CockpitConfig& config, const Dbc& dbc) {
  Feedback feedback;
  for (const SendMessage& send : config.sends) {
    const auto index = find_message(dbc, send.message, send.place);
    if (!index) return index.error();
    BoundMessage bound;
    bound.message = dbc.messages[*index];
    bound.period_ns = static_cast<std::int64_t>(send.period_s * 1e9);
    for (const SendSignal& signal : send.signals) {
      const auto found = find_signal(dbc, bound.message, signal.signal, signal.place);
      if (!found) return found.error();
      bound.signals.push_back({bound.message.signals[*found], signal.value});
    }
    for (const MessageCheck& check : config.checks) {
      if (check.message != send.message) continue;
      auto signer = MessageChecker::bind(check, dbc, bound.message);
      if (!signer) return signer.error();
      bound.signer = std::move(*signer);
    }
    feedback.messages_.push_back(std::move(bound));
  }
  return feedback;
}

std::vector<CanFrame> Feedback::due(const FeedbackValues& values, std::int64_t now_ns) {
  std::vector<CanFrame> frames;
  for (BoundMessage& bound : messages_) {
    const bool over = !bound.sent_ns || now_ns - *bound.sent_ns >= bound.period_ns;
    if (!over && !must_not_wait(values, bound.sent)) continue;
    CanFrame frame = empty_frame(bound.message);
    for (const BoundSignal& s : bound.signals) write(bound.message, s.signal, value_of(s.value, values), frame);
    if (bound.signer) bound.signer->sign(frame);
    frames.push_back(frame);
    bound.sent_ns = now_ns;
    bound.sent = values;
  }
  return frames;
}

}  // namespace phare
