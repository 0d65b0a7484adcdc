#include "tools/can_tool.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "cockpit_io/crc.h"
#include "cockpit_io/feedback.h"
#include "cockpit_io/message_check.h"
#include "cockpit_io/signal_map.h"
#include "config/formats/toml_table.h"

namespace phare {
namespace {

std::string short_number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

std::string id_text(std::uint32_t id, bool extended) {
  char text[16];
  std::snprintf(text, sizeof text, extended ? "%08X" : "%03X", id);
  return text;
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

/// The VAL_ name of the frame's value; empty: none.
std::string value_name(const DbcSignal& signal, const CanFrame& frame) {
  const auto raw = raw_value(signal, frame.bytes());
  const auto found = raw ? signal.value_names.find(*raw) : signal.value_names.end();
  return found == signal.value_names.end() ? "" : found->second;
}

/// Of a message, the signals that are asked for.
using Chosen = std::map<const DbcMessage*, std::vector<const DbcSignal*>>;

Result<Chosen> choose(const Dbc& dbc, const std::vector<std::string>& asked) {
  Chosen chosen;
  std::vector<std::string> names, missing;
  for (const DbcMessage& message : dbc.messages) {
    for (const DbcSignal& signal : message.signals) {
      names.push_back(signal.name);
      names.push_back(message.name + "." + signal.name);
      const bool wanted = asked.empty() || std::ranges::find(asked, signal.name) != asked.end() ||
                          std::ranges::find(asked, names.back()) != asked.end();
      if (wanted) chosen[&message].push_back(&signal);
    }
  }
  for (const std::string& name : asked)
    if (std::ranges::find(names, name) == names.end()) missing.push_back(unknown_name_reason("signal", name, names));
  if (missing.empty()) return chosen;
  std::string all;
  for (const std::string& reason : missing) all += (all.empty() ? "" : "; ") + reason;
  return Error{dbc.file.string(), all};
}

// ---- which control moves

struct Shown {
  std::string name, value;
};

std::vector<Shown> shown(const DriverInput& input) {
  constexpr std::array<const char*, 4> kLevers{"neutral", "push", "pull", "half"};
  constexpr std::array<const char*, 3> kTurns{"none", "left", "right"};
  constexpr std::array<const char*, 4> kGears{"drive", "neutral", "reverse", "park"};
  const SwitchInput& s = input.switches;
  const auto flag = [](bool on) { return std::string(on ? "on" : "off"); };
  const auto percent = [](double share) { return std::to_string(static_cast<int>(share * 100.0 + 0.5)) + " %"; };
  const int wheel_deg = static_cast<int>(std::lround(input.steering_wheel_rad * 180.0 / std::numbers::pi));
  return {{"light_switch", std::string(kLightSwitchNames[static_cast<std::size_t>(s.stalk)])},
          {"beam_lever", kLevers[static_cast<std::size_t>(s.lever)]},
          {"high", flag(s.high)},
          {"flash", flag(s.flash)},
          {"fog_front", flag(s.fog_front)},
          {"fog_rear", flag(s.fog_rear)},
          {"turn", kTurns[static_cast<std::size_t>(s.turn)]},
          {"hazard", flag(s.hazard)},
          {"ignition", flag(s.ignition)},
          {"automatic_high", flag(s.automatic)},
          {"design_next", flag(s.design_next)},
          {"design_previous", flag(s.design_previous)},
          {"gear", kGears[static_cast<std::size_t>(input.gear)]},
          {"steering", std::to_string(wheel_deg) + " deg"},
          {"accelerator", percent(input.accelerator_01)},
          {"brake", percent(input.brake_01)},
          {"clutch", percent(input.clutch_01)},
          {"parking_brake", percent(input.parking_brake_01)}};
}

/// Wheel and pedals move all the time: a line for a change since the last line of them, a second apart at least.
bool is_steady(const std::string& name) {
  return name == "steering" || name == "accelerator" || name == "brake" || name == "clutch" || name == "parking_brake";
}

// ---- which check fits

/// All different frames of one message.
struct OfOneId {
  CanId id;
  std::vector<CanFrame> frames;
};

std::vector<OfOneId> different_frames(const CandumpLog& log) {
  constexpr std::size_t kMost = 400;
  std::map<std::pair<std::uint32_t, bool>, OfOneId> all;
  for (const CandumpEntry& entry : log.entries) {
    if (!entry.frame.carries_data() || entry.frame.length < 2) continue;
    OfOneId& of = all[{entry.frame.id, entry.frame.extended}];
    of.id = {entry.frame.id, entry.frame.extended};
    const bool known = std::ranges::find(of.frames, entry.frame) != of.frames.end();
    if (of.frames.size() < kMost && !known && (of.frames.empty() || of.frames[0].length == entry.frame.length))
      of.frames.push_back(entry.frame);
  }
  std::vector<OfOneId> list;
  for (auto& [id, of] : all) list.push_back(std::move(of));
  return list;
}

/// A message with nothing but a check in `bits` bits from `start_bit` on.
std::optional<MessageChecker> checker_for(CrcKind kind, std::uint32_t start_bit, std::uint32_t bits,
                                          std::uint32_t length, std::vector<std::int64_t> data_ids) {
  Dbc dbc;
  DbcMessage message;
  message.name = "M";
  message.length_bytes = length;
  DbcSignal crc;
  crc.name = "CRC";
  crc.start_bit = start_bit;
  crc.length_bits = bits;
  message.signals.push_back(crc);
  MessageCheck check;
  check.message = "M";
  check.crc = "CRC";
  check.crc_kind = kind;
  check.data_ids = std::move(data_ids);
  auto bound = MessageChecker::bind(check, dbc, message);
  return bound ? std::optional(std::move(*bound)) : std::nullopt;
}

bool all_fit(MessageChecker& checker, const std::vector<CanFrame>& frames) {
  return std::ranges::all_of(frames, [&](const CanFrame& frame) {
    CanFrame made = frame;
    checker.sign(made);
    return made == frame;
  });
}

/// CRC-8/AUTOSAR with a data id for each value of a counter (E2E profile 2): the ids, by the counter; empty: it is not.
std::vector<std::int64_t> profile_2_ids(const std::vector<CanFrame>& frames, std::size_t crc_byte,
                                        std::size_t counter_byte, bool high_nibble) {
  std::array<std::optional<int>, 16> ids{};
  std::array<int, 16> seen{};
  for (const CanFrame& frame : frames) {
    Crc before(kCrc8H2f);
    for (std::size_t i = 0; i < frame.length; ++i)
      if (i != crc_byte) before.add(frame.data[i]);
    int fits = -1;  // the last byte of a CRC can be solved for: one id gives this value
    for (int id = 0; id < 256 && fits < 0; ++id) {
      Crc with = before;
      with.add(static_cast<std::uint8_t>(id));
      if (with.value() == frame.data[crc_byte]) fits = id;
    }
    const std::size_t counter = (frame.data[counter_byte] >> (high_nibble ? 4 : 0)) & 15u;
    if (ids[counter] && ids[counter] != fits) return {};
    ids[counter] = fits;
    ++seen[counter];
  }
  std::vector<std::int64_t> all;
  std::set<std::int64_t> different;
  for (std::size_t counter = 0; counter < 16; ++counter) {
    if (!ids[counter] || seen[counter] < 2) return {};
    all.push_back(*ids[counter]);
    different.insert(*ids[counter]);
  }
  return different.size() > 1 ? all : std::vector<std::int64_t>{};
}

std::string ids_text(const std::vector<std::int64_t>& ids) {
  std::string text = "[";
  for (const std::int64_t id : ids) text += (text.size() > 1 ? ", " : "") + std::to_string(id);
  return text + "]";
}

}  // namespace

void tell_problems(const Dbc& dbc, std::ostream& out) {
  for (std::size_t i = 0; i < dbc.problems.size() && i < kProblemsNamed; ++i) {
    const DbcProblem& p = dbc.problems[i];
    out << dbc.file.string() << ":" << p.line << ": " << (p.signal.empty() ? p.message : p.signal)
        << (p.signal.empty() && p.message.empty() ? "" : ": ") << p.reason << "\n";
  }
  if (dbc.problems.size() > kProblemsNamed)
    out << dbc.file.string() << ": and " << dbc.problems.size() - kProblemsNamed << " more\n";
}

void tell_problems(const CandumpLog& log, std::ostream& out) {
  const std::size_t named = std::min(log.problems.size(), kProblemsNamed);
  for (std::size_t i = 0; i < named; ++i)
    out << log.file.string() << ":" << log.problems[i].line << ": " << log.problems[i].reason << "\n";
  if (log.broken_lines > named) out << log.file.string() << ": and " << log.broken_lines - named << " more\n";
}

void list_dbc(const Dbc& dbc, std::ostream& out) {
  for (const DbcMessage& message : dbc.messages) {
    out << id_text(message.id, message.extended) << " " << message.name << ", " << message.length_bytes << " bytes"
        << (message.fd ? ", CAN FD" : "") << (message.comment.empty() ? "" : "  # " + message.comment) << "\n";
    for (const DbcSignal& s : message.signals) {
      out << "    " << s.name << "  " << s.start_bit << "|" << s.length_bits << "@" << (s.motorola ? "0" : "1")
          << (s.type == DbcSignal::Type::kUnsigned ? "+" : "-");
      if (s.factor != 1.0 || s.offset != 0.0)
        out << "  * " << short_number(s.factor) << " + " << short_number(s.offset);
      if (s.minimum != 0.0 || s.maximum != 0.0)
        out << "  " << short_number(s.minimum) << " to " << short_number(s.maximum);
      if (!s.unit.empty()) out << " " << s.unit;
      if (s.is_multiplexor) out << "  multiplexor";
      if (!s.multiplexor.empty()) {
        out << "  where " << s.multiplexor << " is";
        for (const MultiplexRange& range : s.multiplex_values)
          out << " " << range.first << (range.last > range.first ? "-" + std::to_string(range.last) : "");
      }
      for (const auto& [value, name] : s.value_names) out << "  " << value << " \"" << name << "\"";
      out << "\n";
    }
  }
  out << dbc.messages.size() << " messages, " << dbc.signal_count() << " signals, " << dbc.problems.size()
      << " lines that cannot be used\n";
}

Status decode_log(const Dbc& dbc, const CandumpLog& log, const DecodeAsked& asked, std::ostream& out) {
  const auto chosen = choose(dbc, asked.signals);
  if (!chosen) return chosen.error();
  if (std::ranges::none_of(log.entries, [&](const CandumpEntry& entry) {
        return dbc.find(entry.frame.id, entry.frame.extended) != nullptr;
      }))
    return Error{log.file.string(), "of its " + std::to_string(log.entries.size()) + " frames the DBC file knows none"};
  if (asked.csv) out << "t_s,message,signal,value,unit,name\n";
  for (const CandumpEntry& entry : log.entries) {
    const DbcMessage* message = dbc.find(entry.frame.id, entry.frame.extended);
    const auto of = message == nullptr ? chosen->end() : chosen->find(message);
    if (of == chosen->end()) continue;
    char stamp[40];
    std::snprintf(stamp, sizeof stamp, "%lld.%06lld", static_cast<long long>(entry.stamp_ns / 1'000'000'000),
                  static_cast<long long>(entry.stamp_ns % 1'000'000'000 / 1000));
    std::string line;
    for (const DbcSignal* signal : of->second) {
      const auto value = decode(*message, *signal, entry.frame);
      if (!value) continue;
      const std::string name = value_name(*signal, entry.frame);
      if (asked.csv) {
        out << stamp << "," << csv_field(message->name) << "," << csv_field(signal->name) << "," << short_number(*value)
            << "," << csv_field(signal->unit) << "," << csv_field(name) << "\n";
      } else {
        line += "  " + signal->name + " " + short_number(*value) + (signal->unit.empty() ? "" : " " + signal->unit) +
                (name.empty() ? "" : " \"" + name + "\"");
      }
    }
    if (!line.empty()) out << stamp << " " << message->name << line << "\n";
  }
  return Done{};
}

Status check_cockpit(const CockpitConfig& config, const Dbc& dbc, const CandumpLog& log, std::ostream& out) {
  auto map = SignalMap::bind(config, dbc, 0);
  if (!map) return map.error();
  if (const auto sends = Feedback::bind(config, dbc); !sends) return sends.error();
  DriverInput input = initial_input(config);
  std::vector<Shown> last = shown(input);
  std::vector<std::size_t> moves(last.size(), 0);
  std::map<std::string, double> told_s;
  std::uint64_t used = 0, incomplete = 0, bad_crc = 0, bad_counter = 0, silences = 0;
  bool silent = false;
  char text[160];
  const std::int64_t begin_ns = log.entries.empty() ? 0 : log.entries.front().stamp_ns;
  std::int64_t at_ns = 0;
  for (const CandumpEntry& entry : log.entries) {
    at_ns = std::max(at_ns, entry.stamp_ns - begin_ns);
    const double t_s = static_cast<double>(at_ns) * 1e-9;
    if (!silent && map->silent_at_ns() <= at_ns) {
      silent = true;
      ++silences;
      std::snprintf(text, sizeof text, "%10.3f s  silent: %s; the fail-safe would give low beam\n",
                    static_cast<double>(map->silent_at_ns()) * 1e-9, map->most_silent().c_str());
      out << text;
    }
    switch (map->take(entry.frame, at_ns, input)) {
      case SignalMap::Taken::kNotMapped:
        continue;
      case SignalMap::Taken::kBadCrc:
        ++bad_crc;
        continue;
      case SignalMap::Taken::kBadCounter:
        ++bad_counter;
        continue;
      case SignalMap::Taken::kIncomplete:
        ++incomplete;
        break;
      case SignalMap::Taken::kDecoded:
        ++used;
        break;
    }
    silent = silent && map->silent_at_ns() <= at_ns;
    const std::vector<Shown> now = shown(input);
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (now[i].value == last[i].value) continue;
      const auto told = told_s.find(now[i].name);
      if (is_steady(now[i].name) && told != told_s.end() && t_s - told->second < 1.0) continue;
      told_s[now[i].name] = t_s;
      ++moves[i];
      std::snprintf(text, sizeof text, "%10.3f s  %-15s %s -> %s\n", t_s, now[i].name.c_str(), last[i].value.c_str(),
                    now[i].value.c_str());
      out << text;
      last[i] = now[i];
    }
  }
  for (const ControlMapping& mapping : config.controls) {
    const std::string name(kControlNames[static_cast<std::size_t>(mapping.control)]);
    const auto found = std::ranges::find(last, name, &Shown::name);
    if (found != last.end() && moves[static_cast<std::size_t>(found - last.begin())] == 0)
      out << name << " (" << mapping.message << "." << mapping.signal << ") never moves\n";
  }
  out << log.entries.size() << " frames, " << used << " used, " << incomplete
      << " too short or with a value that means nothing, " << bad_crc << " refused by their checksum, " << bad_counter
      << " by their counter, silent " << silences << " times\n";
  return Done{};
}

std::vector<CrcFound> find_crcs(const CandumpLog& log, std::size_t least) {
  std::vector<CrcFound> found;
  for (const OfOneId& of : different_frames(log)) {
    if (of.frames.size() < least) continue;
    const std::uint32_t length = of.frames[0].length;
    const auto add = [&](const std::string& scheme, const std::string& where) {
      found.push_back({of.id, of.frames.size(), scheme, where});
    };
    const auto try_kind = [&](CrcKind kind, std::uint32_t start_bit, std::uint32_t bits, const std::string& where,
                              std::vector<std::int64_t> ids = {}) {
      auto checker = checker_for(kind, start_bit, bits, length, ids);
      if (!checker || !all_fit(*checker, of.frames)) return false;
      add("crc_kind = \"" + std::string(kCrcNames[static_cast<std::size_t>(kind)]) + "\"" +
              (ids.empty() ? "" : ", data_id = " + std::to_string(ids[0])),
          where);
      return true;
    };
    // The nibble at the end of the last byte, with Honda.
    try_kind(CrcKind::kHonda, 8 * (length - 1), 4, "the last nibble");
    for (std::uint32_t byte = 0; byte < length; ++byte) {
      // A byte that never changes is no check.
      const bool changes = std::ranges::any_of(
          of.frames, [&](const CanFrame& frame) { return frame.data[byte] != of.frames[0].data[byte]; });
      if (!changes) continue;
      const std::string where = "byte " + std::to_string(byte);
      for (const CrcKind kind :
           {CrcKind::kCrc8, CrcKind::kCrc8SaeJ1850, CrcKind::kXor8, CrcKind::kSum8, CrcKind::kToyota})
        try_kind(kind, 8 * byte, 8, where);
      if (try_kind(CrcKind::kCrc8H2f, 8 * byte, 8, where)) continue;
      bool with_id = false;
      for (std::int64_t id = 0; id < 256 && !with_id; ++id)
        with_id = try_kind(CrcKind::kCrc8H2f, 8 * byte, 8, where, {id});
      for (std::size_t counter = 0; counter < length && !with_id; ++counter) {
        for (const bool high : {false, true}) {
          if (counter == byte || with_id) continue;
          const auto ids = profile_2_ids(of.frames, byte, counter, high);
          if (ids.empty()) continue;
          with_id = true;
          add("crc_kind = \"e2e-p2\", data_ids = " + ids_text(ids),
              where + ", counter in the " + (high ? "upper" : "lower") + " half of byte " + std::to_string(counter));
        }
      }
    }
    for (std::uint32_t byte = 0; byte + 2 <= length; ++byte)
      for (const CrcKind kind : {CrcKind::kCrc16CcittFalse, CrcKind::kCrc16Arc})
        try_kind(kind, 8 * byte, 16, "bytes " + std::to_string(byte) + " and " + std::to_string(byte + 1));
  }
  return found;
}

}  // namespace phare
