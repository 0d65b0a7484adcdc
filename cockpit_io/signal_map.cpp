#include "cockpit_io/signal_map.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "cockpit_io/text_scanner.h"
#include "config/formats/toml_table.h"

namespace phare {

namespace {

/// Gives a named value its number.
Status look_up(const Dbc& dbc, const DbcSignal& signal, NamedValue& value) {
  std::vector<std::string> names;
  for (const auto& [raw, name] : signal.value_names) {
    if (name == value.name) {
      value.value = static_cast<double>(raw) * signal.factor + signal.offset;
      return Done{};
    }
    names.push_back(name);
  }
  if (names.empty()) {
    return Error{value.place, "signal \"" + signal.name + "\" has no value names (VAL_) in " +
                                  dbc.file.filename().string() + "; write the number that means \"" + value.name +
                                  "\""};
  }
  return Error{value.place, unknown_name_reason("value", value.name, names) + " (of signal " + signal.name + ")"};
}

/// Gives a number the very value that the signal is decoded to: written 0.3, where the factor is 0.1, it is 3 × 0.1.
Status settle(const DbcSignal& signal, NamedValue& value) {
  const auto nearest = nearest_value(signal, value.value);
  const bool real = signal.type == DbcSignal::Type::kFloat || signal.type == DbcSignal::Type::kDouble;
  // Of a step: a number in a file has as many digits as somebody wrote.
  const double written_to = 1e-9 * (std::abs(signal.factor) + std::abs(value.value));
  if (!nearest || (!real && std::abs(*nearest - value.value) > written_to))
    return Error{value.place, "signal \"" + signal.name + "\" never is " + physical_text(value.value) +
                                  (nearest ? "; next to it is " + physical_text(*nearest)
                                           : ": it has " + std::to_string(signal.length_bits) + " bits")};
  value.value = *nearest;
  return Done{};
}

/// Does a DBC file call a value so where there is none: "SNA", "LIGHT_SNA", "INVALID", "Signal not available"?
bool names_no_value(std::string name) {
  for (char& c : name) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c == ' ' || c == '-' ? '_' : c;
  return std::ranges::any_of(std::array{"SNA", "INVALID", "NOT_AVAILABLE", "UNAVAILABLE", "NOT_VALID"},
                             [&](const std::string& last) { return name == last || name.ends_with("_" + last); });
}

/// What the mapping compares with the signal: names become numbers, and numbers values that the signal has. Values that
/// the DBC file names so mean nothing, unless the mapping says what they mean or has the signal elsewhere.
Status look_up_all(const Dbc& dbc, const DbcSignal& signal, ControlMapping& mapping) {
  std::vector<NamedValue*> values;
  for (SignalLevel& level : mapping.levels) values.push_back(&level.when);
  for (NamedValue& value : mapping.on) values.push_back(&value);
  for (NamedValue& value : mapping.invalid) values.push_back(&value);
  const bool alone = mapping.fine_signal.empty() && mapping.sign_signal.empty();
  for (NamedValue* value : values) {
    const bool named = !value->name.empty();
    const Status status = named ? look_up(dbc, signal, *value) : alone ? settle(signal, *value) : Status(Done{});
    if (!status) return status;
  }
  if (!mapping.bits.empty()) return Done{};
  std::vector<NamedValue> named_so;  // `values` points into the mapping, which stays as it is meanwhile
  for (const auto& [raw, name] : signal.value_names) {
    const double value = static_cast<double>(raw) * signal.factor + signal.offset;
    const bool said = std::ranges::any_of(values, [&](const NamedValue* other) { return other->value == value; });
    if (!said && names_no_value(name)) named_so.push_back({value, name});
  }
  mapping.invalid.insert(mapping.invalid.end(), named_so.begin(), named_so.end());
  return Done{};
}

}  // namespace

Result<DbcSignal> laid_out(const ControlMapping& mapping, const DbcMessage& message, const DbcSignal& signal) {
  if (mapping.bits.empty()) return signal;
  TextScanner scan(mapping.bits);
  const auto start = scan.number<std::uint32_t>();
  const auto length = start && scan.take('|') ? scan.number<std::uint32_t>() : std::nullopt;
  const bool at = length && scan.take('@');
  const bool motorola = at && scan.take('0');
  const bool order = motorola || (at && scan.take('1'));
  const bool is_signed = order && scan.take('-');
  if (!order || (!is_signed && !scan.take('+')) || !scan.at_end())
    return Error{mapping.bits_place,
                 "bits \"" + mapping.bits + "\": expected start|length@order and sign, such as \"16|4@1+\""};
  DbcSignal laid = signal;
  laid.start_bit = *start;
  laid.length_bits = *length;
  laid.motorola = motorola;
  laid.type = is_signed ? DbcSignal::Type::kSigned : DbcSignal::Type::kUnsigned;
  const bool fits =
      *length >= 1 && *length <= 64 && *start < 8 * message.length_bytes && bytes_needed(laid) <= message.length_bytes;
  if (!fits)
    return Error{mapping.bits_place, "bits \"" + mapping.bits + "\" do not fit message " + message.name + " of " +
                                         std::to_string(message.length_bytes) + " bytes"};
  return laid;
}

Result<SignalMap> SignalMap::bind(const CockpitConfig& config, Dbc dbc, std::int64_t start_ns) {
  SignalMap map;
  map.config_ = config;
  map.dbc_ = std::move(dbc);
  for (ControlMapping mapping : config.controls) {
    const auto message = find_message(map.dbc_, mapping.message, mapping.message_place);
    if (!message) return message.error();
    const DbcMessage& dbc_message = map.dbc_.messages[*message];
    const auto signal = find_signal(map.dbc_, dbc_message, mapping.signal, mapping.signal_place);
    if (!signal) return signal.error();
    std::optional<std::size_t> others[2];
    for (int i = 0; i < 2; ++i) {
      const std::string& name = i == 0 ? mapping.fine_signal : mapping.sign_signal;
      if (name.empty()) continue;
      const auto found = find_signal(map.dbc_, dbc_message, name, i == 0 ? mapping.fine_place : mapping.sign_place);
      if (!found) return found.error();
      others[i] = *found;
    }
    auto laid = laid_out(mapping, dbc_message, dbc_message.signals[*signal]);
    if (!laid) return laid.error();
    if (const Status status = look_up_all(map.dbc_, *laid, mapping); !status) return status.error();

    auto bound =
        std::find_if(map.messages_.begin(), map.messages_.end(), [&](const auto& m) { return m.message == *message; });
    if (bound == map.messages_.end()) {
      bound = map.messages_.insert(bound, BoundMessage{*message, {}, std::nullopt, 0, start_ns});
    }
    bound->timeout_ns = std::max(bound->timeout_ns, static_cast<std::int64_t>(mapping.timeout_s * 1e9));
    const double debounce_s = mapping.debounce_s.value_or(config.debounce_s);
    bound->controls.push_back({ControlReader(std::move(mapping), static_cast<std::int64_t>(debounce_s * 1e9)),
                               std::move(*laid),
                               others[0],
                               others[1],
                               {}});
  }
  for (const MessageCheck& check : config.checks) {
    const auto message = find_message(map.dbc_, check.message, check.message_place);
    if (!message) return message.error();
    auto checker = MessageChecker::bind(check, map.dbc_, map.dbc_.messages[*message]);
    if (!checker) return checker.error();
    const auto bound =
        std::find_if(map.messages_.begin(), map.messages_.end(), [&](const auto& m) { return m.message == *message; });
    const bool sent = std::any_of(config.sends.begin(), config.sends.end(),
                                  [&](const SendMessage& send) { return send.message == check.message; });
    if (bound == map.messages_.end() && !sent)
      return Error{check.place, "no control comes from message \"" + check.message + "\", and it is not sent"};
    if (bound != map.messages_.end()) bound->checker = std::move(*checker);
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
  if (bound->checker) {
    const auto verdict = bound->checker->take(frame);
    if (verdict == MessageChecker::Verdict::kBadCrc) return Taken::kBadCrc;
    if (verdict == MessageChecker::Verdict::kBadCounter) return Taken::kBadCounter;
  }
  bool complete = true, life = true;
  for (BoundControl& control : bound->controls) {
    const Read how = read(control, dbc_.messages[bound->message], frame, at_ns, bits_, input);
    complete = complete && how != Read::kUnfit && how != Read::kUnknown;
    // A frame too short to read does not prove that the stalk is there, nor does one whose beam switch says nothing
    // that means something; that the turn lever stands where nobody knows takes no beam away.
    life = life && how != Read::kUnfit && !(how == Read::kUnknown && control.decides_beam());
  }
  settle_bits(config_, bits_, input);
  if (life) bound->last_ns = std::max(bound->last_ns, at_ns);
  return complete ? Taken::kDecoded : Taken::kIncomplete;
}

bool SignalMap::BoundControl::decides_beam() const {
  constexpr std::array kDecide{Control::kLightSwitch, Control::kBeamLever, Control::kPosition, Control::kLow,
                               Control::kHigh};
  return std::ranges::find(kDecide, reader.mapping().control) != kDecide.end();
}

SignalMap::Read SignalMap::read(BoundControl& control, const DbcMessage& message, const CanFrame& frame,
                                std::int64_t at_ns, BeamBits& bits, DriverInput& input) {
  const DbcSignal& signal = control.signal;
  const auto decoded = decode(message, signal, frame);
  // Of a multiplexed message each frame holds a part; the others come with the next frames.
  if (!decoded && !signal.multiplexor.empty() && bytes_needed(signal) <= frame.length) return Read::kAbsent;
  if (!decoded) return Read::kUnfit;
  double value = *decoded;
  const bool invalid = std::ranges::any_of(control.reader.mapping().invalid,
                                           [&](const NamedValue& nothing) { return nothing.value == value; });
  if (control.fine_signal) {
    const auto fine = decode(message, message.signals[*control.fine_signal], frame);
    if (!fine) return Read::kUnfit;
    value += *fine;
  }
  if (control.sign_signal) {
    const auto sign = decode(message, message.signals[*control.sign_signal], frame);
    if (!sign) return Read::kUnfit;
    if (*sign != 0.0) value = -value;
  }
  if (!invalid && control.reader.take(value, at_ns, bits, input)) return Read::kRead;
  constexpr std::size_t kMostTold = 16;
  auto& told = control.unknown;
  if (told.size() < kMostTold && std::find(told.begin(), told.end(), value) == told.end()) {
    told.push_back(value);
    spdlog::warn("{}: {} is {}, which {}; the control stays as it was", message.name, signal.name, value,
                 invalid ? "means that there is no value" : "none of its levels in the cockpit file means");
  }
  return Read::kUnknown;
}

void SignalMap::remember(Memory& memory) {
  memory.field(bits_);
  for (BoundMessage& message : messages_) {
    memory.field(message.last_ns);
    for (BoundControl& control : message.controls) control.reader.remember(memory);
  }
}

const SignalMap::BoundMessage* SignalMap::first_silent() const {
  const auto first = std::min_element(messages_.begin(), messages_.end(), [](const auto& a, const auto& b) {
    return a.last_ns + a.timeout_ns < b.last_ns + b.timeout_ns;
  });
  return first == messages_.end() ? nullptr : &*first;
}

std::int64_t SignalMap::silent_at_ns() const {
  const BoundMessage* first = first_silent();
  return first == nullptr ? std::numeric_limits<std::int64_t>::max() : first->last_ns + first->timeout_ns;
}

const std::string& SignalMap::most_silent() const {
  static const std::string kNone;
  const BoundMessage* first = first_silent();
  return first == nullptr ? kNone : dbc_.messages[first->message].name;
}

std::vector<CanId> SignalMap::ids() const {
  std::vector<CanId> ids;
  for (const BoundMessage& m : messages_)
    ids.push_back({dbc_.messages[m.message].id, dbc_.messages[m.message].extended});
  return ids;
}

std::uint64_t SignalMap::lost() const {
  std::uint64_t lost = 0;
  for (const BoundMessage& m : messages_) lost += m.checker ? m.checker->lost() : 0;
  return lost;
}

}  // namespace phare
