#include "tools/can_tool.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "cockpit_io/feedback.h"
#include "cockpit_io/signal_map.h"
#include "config/formats/toml_table.h"
#include "tools/value_text.h"

namespace phare {
namespace {

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
  for (const std::string& doubt : doubts(log)) out << doubt << "\n";
}

void list_dbc(const Dbc& dbc, std::ostream& out) {
  for (const DbcMessage& message : dbc.messages) {
    out << id_text(message.id, message.extended) << " " << message.name << ", " << message.length_bytes << " bytes"
        << (message.fd ? ", CAN FD" : "") << (message.comment.empty() ? "" : "  # " + message.comment) << "\n";
    for (const DbcSignal& s : message.signals) {
      out << "    " << s.name << "  " << s.start_bit << "|" << s.length_bits << "@" << (s.motorola ? "0" : "1")
          << (s.type == DbcSignal::Type::kUnsigned ? "+" : "-")
          << (s.type == DbcSignal::Type::kFloat    ? " float"
              : s.type == DbcSignal::Type::kDouble ? " double"
                                                   : "");
      if (s.factor != 1.0 || s.offset != 0.0)
        out << "  * " << shortest_text(s.factor) << " + " << shortest_text(s.offset);
      if (s.minimum != 0.0 || s.maximum != 0.0)
        out << "  " << shortest_text(s.minimum) << " to " << shortest_text(s.maximum);
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
  const bool several = log.interfaces.size() > 1;
  if (asked.csv) out << "t_s,message,signal,value,unit,name" << (several ? ",interface" : "") << "\n";
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
      const std::string number = value_text(*signal, raw_bits(*signal, entry.frame.bytes()).value_or(0), *value);
      if (asked.csv) {
        out << stamp << "," << csv_field(message->name) << "," << csv_field(signal->name) << "," << number << ","
            << csv_field(signal->unit) << "," << csv_field(name)
            << (several ? "," + csv_field(log.interfaces[entry.interface]) : "") << "\n";
      } else {
        line += "  " + signal->name + " " + number + (signal->unit.empty() ? "" : " " + signal->unit) +
                (name.empty() ? "" : " \"" + name + "\"");
      }
    }
    if (!line.empty())
      out << stamp << (several ? " " + log.interfaces[entry.interface] : "") << " " << message->name << line << "\n";
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

}  // namespace phare
