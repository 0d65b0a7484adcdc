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

/// Writes the value, or the nearest that fits: a speed backwards in an unsigned signal is 0.
void write(const DbcMessage& message, const DbcSignal& s, double value, CanFrame& frame) {
  if (encode(message, s, value, frame) || s.type == DbcSignal::Type::kFloat || s.type == DbcSignal::Type::kDouble)
    return;
  const bool is_signed = s.type == DbcSignal::Type::kSigned;
  const double end = std::ldexp(1.0, static_cast<int>(s.length_bits) - (is_signed ? 1 : 0));
  const double first = (is_signed ? -end : 0.0) * s.factor + s.offset;
  const double last = (end - 1.0) * s.factor + s.offset;
  encode(message, s, std::clamp(value, std::min(first, last), std::max(first, last)), frame);
}

/// Whether something a driver would see at once has changed; speed and steering wait for the period.
bool must_not_wait(const FeedbackValues& a, const FeedbackValues& b) {
  return a.telltales != b.telltales || a.light != b.light || a.design_index != b.design_index;
}

}  // namespace

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
