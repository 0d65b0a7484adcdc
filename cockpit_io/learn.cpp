#include "cockpit_io/learn.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

namespace phare {

namespace {

constexpr std::uint64_t kMostMoves = 40;  // of one signal are shown
constexpr std::size_t kMostValues = 16;   // more of them: an angle or a pedal, not a switch

std::string id_text(std::uint32_t id, bool extended) {
  char text[16];
  std::snprintf(text, sizeof text, extended ? "%08X" : "%03X", id);
  return text;
}

std::string value_text(const DbcSignal* s, std::uint64_t raw) {
  if (s == nullptr) return std::to_string(raw);
  std::string text = physical_text(physical_value(*s, raw).value_or(0.0)) + (s->unit.empty() ? "" : " " + s->unit);
  const auto key = s->type == DbcSignal::Type::kSigned && s->length_bits < 64 && (raw >> (s->length_bits - 1)) != 0
                       ? static_cast<std::int64_t>(raw) - (std::int64_t{1} << s->length_bits)
                       : static_cast<std::int64_t>(raw);
  if (const auto name = s->value_names.find(key); name != s->value_names.end()) text += " (" + name->second + ")";
  return text;
}

}  // namespace

std::string Learner::name_of(const Key& key) const {
  if (const DbcMessage* message = dbc_.find(key.id, key.extended))
    return message->name + "." + message->signals[key.index].name;
  return id_text(key.id, key.extended) + " byte " + std::to_string(key.index / 8) + " bit " +
         std::to_string(key.index % 8);
}

std::optional<std::string> Learner::watch(Key key, std::uint64_t raw, const DbcSignal* signal, std::int64_t at_ns) {
  const auto [found, first] = watched_.try_emplace(key);
  Watched& w = found->second;
  if (first) {
    w.raw = w.at_rest = raw;
    // A signal that shows up only now is one that is sent when something moves.
    if (at_ns >= rest_ns_) ++w.values[raw];
    return std::nullopt;
  }
  if (raw == w.raw) return std::nullopt;
  const std::uint64_t before = std::exchange(w.raw, raw);
  if (at_ns < rest_ns_) {
    w.restless = true;
    return std::nullopt;
  }
  if (w.restless) return std::nullopt;
  ++w.moves;
  if (w.values.size() <= kMostValues) ++w.values[before], ++w.values[raw];
  // A wheel that turns, or a bit of one, would fill the screen.
  if (w.values.size() > kMostValues || w.moves > kMostMoves) return std::nullopt;
  char time[32];
  std::snprintf(time, sizeof time, "%9.3f s  ", static_cast<double>(at_ns) * 1e-9);
  std::string line = time + name_of(key) + "  " + value_text(signal, before) + " -> " + value_text(signal, raw);
  if (signal != nullptr && !signal->comment.empty()) line += "   " + signal->comment.substr(0, 60);
  return line;
}

std::vector<std::string> Learner::take(const CanFrame& frame, std::int64_t at_ns) {
  std::vector<std::string> lines;
  if (!frame.carries_data()) return lines;
  ++frames_;
  const auto show = [&](std::optional<std::string> line) {
    if (line) lines.push_back(std::move(*line));
  };
  const auto [heard, first] = ids_.try_emplace({frame.id, frame.extended}, Heard{frame.length, at_ns, 0});
  heard->second.length = std::max<std::uint32_t>(heard->second.length, frame.length);
  if (!first) heard->second.longest_ns = std::max(heard->second.longest_ns, at_ns - heard->second.last_ns);
  heard->second.last_ns = at_ns;
  if (const DbcMessage* message = dbc_.find(frame.id, frame.extended)) {
    for (std::uint32_t i = 0; i < message->signals.size(); ++i) {
      const DbcSignal& signal = message->signals[i];
      if (!is_present(*message, signal, frame.bytes())) continue;
      show(watch({frame.id, frame.extended, i}, *raw_bits(signal, frame.bytes()), &signal, at_ns));
    }
    return lines;
  }
  if (!dbc_.messages.empty()) return lines;  // of ids that the DBC does not know, a bit says little
  for (std::uint32_t bit = 0; bit < 8u * frame.length; ++bit) {
    show(watch({frame.id, frame.extended, bit}, (frame.data[bit / 8] >> bit % 8) & 1u, nullptr, at_ns));
  }
  return lines;
}

namespace {

/// A value as a cockpit file writes it: its name in the DBC file, else the number after factor and offset.
std::string level_value(const DbcSignal& signal, std::uint64_t raw) {
  const auto named = signal.value_names.find(static_cast<std::int64_t>(raw));
  if (named != signal.value_names.end()) return "\"" + named->second + "\"";
  char text[40];
  std::snprintf(text, sizeof text, "%.10g", static_cast<double>(raw) * signal.factor + signal.offset);
  return text;
}

/// What moved between more than two values is a lever or a switch with levels.
std::string levels_text(const DbcSignal& signal, const std::map<std::uint64_t, int>& values, std::uint64_t rest) {
  std::string text = "levels = { neutral = " + level_value(signal, rest);
  const bool lever = values.size() == 3;
  int number = 0;
  for (const auto& [raw, count] : values) {
    if (raw == rest) continue;
    ++number;
    std::string level = lever ? (number == 1 ? "push" : "pull") : "LEVEL_" + std::to_string(number);
    // The DBC file may say itself which is which.
    const auto named = signal.value_names.find(static_cast<std::int64_t>(raw));
    if (lever && named != signal.value_names.end()) {
      if (named->second.find("PULL") != std::string::npos) level = "pull";
      if (named->second.find("PUSH") != std::string::npos) level = "push";
    }
    text += ", " + level + " = " + level_value(signal, raw);
  }
  return text + " }   # it rests at the first; put the levels of the control in place of the others\n";
}

/// The head of a cockpit file, and what may stand in it.
std::string draft_of_source(const std::string& dbc_name) {
  return "\n# A draft of the cockpit file; in place of NAME the control's (docs/cockpit-file.md):\n"
         "#   light_switch: levels off, position, low, high, auto     beam_lever: levels neutral, push, pull, half\n"
         "#   turn: levels none, left, right     gear: levels drive, neutral, reverse, park\n"
         "#   flags: position, low, high, flash, fog_front, fog_rear, turn_left, turn_right, hazard, ignition, …\n"
         "[source]\nkind = \"can\"\ninterface = \"can0\"\ndbc = \"" +
         dbc_name + "\"\nalso = [\"keyboard.toml\"]   # keys, and a gamepad, for what this one has not\n";
}

}  // namespace

std::vector<std::string> Learner::summary() const {
  Moved moved;
  std::size_t restless = 0;
  for (const auto& [key, w] : watched_) {
    restless += w.restless ? 1 : 0;
    if (!w.restless && w.moves > 0) moved.emplace_back(&key, &w);
  }
  std::stable_sort(moved.begin(), moved.end(),
                   [](const auto& a, const auto& b) { return a.second->values.size() < b.second->values.size(); });
  std::vector<std::string> lines;
  lines.push_back(std::to_string(frames_) + " frames of " + std::to_string(ids_.size()) + " ids; " +
                  std::to_string(restless) + " signals changed by themselves and are left out; " +
                  std::to_string(moved.size()) + " moved afterwards:");
  for (const auto& [key, w] : moved) {
    const DbcMessage* message = dbc_.find(key->id, key->extended);
    const DbcSignal* signal = message != nullptr ? &message->signals[key->index] : nullptr;
    std::string line = "  " + name_of(*key) + "  " + std::to_string(w->moves) + " moves, ";
    if (w->values.size() > kMostValues) {
      line += "more than " + std::to_string(kMostValues) + " values: an angle or a pedal";
    } else {
      line += "values";
      for (const auto& [raw, count] : w->values) line += " " + value_text(signal, raw);
    }
    lines.push_back(line);
  }
  const auto draft = dbc_.messages.empty() ? draft_dbc(moved) : draft_cockpit(moved);
  lines.insert(lines.end(), draft.begin(), draft.end());
  return lines;
}

std::vector<std::string> Learner::draft_cockpit(const Moved& moved) const {
  std::vector<std::string> lines;
  for (const auto& [key, w] : moved) {
    const DbcMessage* message = dbc_.find(key->id, key->extended);
    if (message == nullptr || w->values.size() > kMostValues) continue;
    if (lines.empty()) lines.push_back(draft_of_source(dbc_.file.filename().string()));
    const DbcSignal& signal = message->signals[key->index];
    // Twice the longest pause; less than a fifth of a second a busy computer may miss.
    const double longest_s = static_cast<double>(ids_.at({key->id, key->extended}).longest_ns) * 1e-9;
    char timeout[96];
    std::snprintf(timeout, sizeof timeout, "timeout_s = %.1f   # its longest pause was %.2f s\n",
                  std::max(0.2, std::ceil(20.0 * longest_s) / 10.0), longest_s);
    lines.push_back("[control.NAME]\nmessage = \"" + message->name + "\"\nsignal = \"" + signal.name + "\"\n" +
                    (w->values.size() > 2 ? levels_text(signal, w->values, w->at_rest) : "") + timeout);
  }
  return lines;
}

std::vector<std::string> Learner::draft_dbc(const Moved& moved) const {
  std::map<std::pair<std::uint32_t, bool>, std::set<std::uint32_t>> bits;
  for (const auto& [key, w] : moved)
    if (w->moves <= kMostMoves) bits[{key->id, key->extended}].insert(key->index);
  std::vector<std::string> lines;
  for (const auto& [id, of_message] : bits) {
    if (lines.empty())
      lines.push_back(
          "\n# A draft of the DBC file: give the signals names of their own, and learn again with --dbc FILE.");
    const std::uint32_t number = id.second ? id.first | 0x80000000u : id.first;
    std::string text = "BO_ " + std::to_string(number) + " ID_" + id_text(id.first, id.second) + ": " +
                       std::to_string(ids_.at(id).length) + " CAR\n";
    for (auto bit = of_message.begin(); bit != of_message.end();) {
      const std::uint32_t start = *bit;
      std::uint32_t length = 0;
      for (; bit != of_message.end() && *bit == start + length && *bit / 8 == start / 8; ++bit) ++length;
      text += " SG_ BYTE" + std::to_string(start / 8) + "_BIT" + std::to_string(start % 8) + " : " +
              std::to_string(start) + "|" + std::to_string(length) + "@1+ (1,0) [0|" +
              std::to_string((1u << length) - 1u) + "] \"\" PHARE\n";
    }
    lines.push_back(text);
  }
  return lines;
}

}  // namespace phare
