#include "tools/import_signals.h"

#include <algorithm>
#include <cstdio>
#include <numbers>
#include <span>
#include <string_view>

namespace phare {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

/// A spelling of a unit, in small letters, and what one of it is in SI.
struct UnitName {
  std::string_view name;
  double factor;
};
constexpr double kKmh_mps = 1.0 / 3.6, kMph_mps = 0.44704, kKnot_mps = 1852.0 / 3600.0;
constexpr UnitName kSpeedUnits[]{{"m/s", 1.0},         {"mps", 1.0},       {"unit_meterpersecon", 1.0},
                                 {"km/h", kKmh_mps},   {"kph", kKmh_mps},  {"kmh", kKmh_mps},
                                 {"km/hr", kKmh_mps},  {"kmph", kKmh_mps}, {"unit_kilometerperhour", kKmh_mps},
                                 {"mph", kMph_mps},    {"mi/h", kMph_mps}, {"unit_mileperhour", kMph_mps},
                                 {"knots", kKnot_mps}, {"kn", kKnot_mps},  {"kt", kKnot_mps},
                                 {"cm/s", 0.01}};
constexpr UnitName kAngleUnits[]{{"deg", kRadPerDeg},
                                 {"degree", kRadPerDeg},
                                 {"degrees", kRadPerDeg},
                                 {"\xC2\xB0", kRadPerDeg},
                                 {"\xB0", kRadPerDeg},
                                 {"unit_degreofarc", kRadPerDeg},
                                 {"rad", 1.0},
                                 {"radian", 1.0},
                                 {"radians", 1.0}};
constexpr UnitName kShareUnits[]{{"%", 0.01}, {"percent", 0.01}, {"pct", 0.01}, {"unit_percent", 0.01},
                                 {"", 1.0},   {"-", 1.0},        {"1", 1.0}};

/// The units of a control, and the option that names one where the DBC file does not.
struct UnitsOf {
  std::string_view what{};
  std::span<const UnitName> names{};
  std::string_view option{};
};
UnitsOf units_of(ControlUnits units) {
  switch (units) {
    case ControlUnits::kSpeed:
      return {"speed", kSpeedUnits, "--speed-unit"};
    case ControlUnits::kAngle:
      return {"angle", kAngleUnits, "--steering-unit"};
    case ControlUnits::kShare:
      return {"share", kShareUnits, {}};
    case ControlUnits::kNone:
      break;
  }
  return {};
}

std::optional<double> si_factor(std::span<const UnitName> names, std::string unit) {
  std::ranges::transform(unit, unit.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  const auto found = std::ranges::find(names, unit, &UnitName::name);
  if (found == names.end()) return std::nullopt;
  return found->factor;
}

}  // namespace

Result<ImportControl> find_control(const Dbc& dbc, const std::string& what, const std::string& path, ControlUnits kind,
                                   const std::string& stated) {
  const UnitsOf units = units_of(kind);
  ImportControl control;
  control.what = what;
  for (std::size_t start = 0; start <= path.size();) {
    const std::size_t end = std::min(path.find('+', start), path.size());
    const std::string term = path.substr(start, end - start);
    start = end + 1;
    const std::size_t dot = term.find('.');
    if (dot == std::string::npos) return Error{what, "expected MESSAGE.SIGNAL, got \"" + term + "\""};
    const DbcMessage* message = dbc.find(term.substr(0, dot));
    if (message == nullptr)
      return Error{dbc.file.string(), "no message \"" + term.substr(0, dot) + "\" for the " + what};
    if (control.message != nullptr && control.message != message)
      return Error{what, "signals of one message only can be added"};
    const DbcSignal* signal = message->find(term.substr(dot + 1));
    if (signal == nullptr) {
      return Error{dbc.file.string() + ":" + std::to_string(message->line),
                   "message " + message->name + " has no signal \"" + term.substr(dot + 1) + "\" for the " + what};
    }
    const std::string& unit = stated.empty() ? signal->unit : stated;
    const auto factor = units.names.empty() ? std::optional(1.0) : si_factor(units.names, unit);
    if (!factor)
      return Error{dbc.file.string() + ":" + std::to_string(signal->line),
                   "signal " + signal->name + " for the " + what + ": its unit \"" + unit + "\" is no " +
                       std::string(units.what) + " that is known" +
                       (units.option.empty() ? "" : "; " + std::string(units.option) + " says which it is")};
    if (control.message != nullptr && *factor != control.factor)
      return Error{what, "signals of one unit only can be added"};
    control.message = message;
    control.signals.push_back(signal);
    control.factor = *factor;
  }
  return control;
}

std::optional<double> decode_control(const ImportControl& control, const CanFrame& frame) {
  double sum = 0.0;
  for (const DbcSignal* signal : control.signals) {
    const auto value = decode(*control.message, *signal, frame);
    if (!value) return std::nullopt;
    sum += *value;
  }
  return sum * control.factor;
}

Status one_recording(const CandumpLog& log) {
  // Chosen: a car that is on is never so long without a frame, nor does a logger swap frames so far.
  constexpr std::int64_t kLongestSilence_ns = 10'000'000'000, kFarthestBack_ns = 1'000'000'000;
  for (std::size_t i = 1; i < log.entries.size(); ++i) {
    const CandumpEntry &before = log.entries[i - 1], &after = log.entries[i];
    const std::int64_t step_ns = after.stamp_ns - before.stamp_ns;
    if (step_ns <= kLongestSilence_ns && step_ns >= -kFarthestBack_ns) continue;
    char text[200];
    std::snprintf(text, sizeof text,
                  "stamped %.6f s, %.6f s before: the clock was set, or several logs are in one; cut it there",
                  static_cast<double>(after.stamp_ns) * 1e-9, static_cast<double>(before.stamp_ns) * 1e-9);
    return Error{log.file.string() + (log.counts_frames ? " frame " : ":") + std::to_string(after.line), text};
  }
  return Done{};
}

std::string widest_gap(const std::string& what, const std::vector<double>& t_s, double begin_s) {
  constexpr double kGap_s = 0.5;
  double widest_s = 0.0, at_s = 0.0;
  std::size_t gaps = 0;
  for (std::size_t i = 1; i < t_s.size(); ++i) {
    const double gap_s = t_s[i] - t_s[i - 1];
    gaps += gap_s > kGap_s ? 1 : 0;
    if (gap_s <= widest_s) continue;
    widest_s = gap_s;
    at_s = t_s[i - 1] - begin_s;
  }
  if (gaps == 0 || 2 * gaps > t_s.size()) return {};  // so few that this is how often it comes
  char text[160];
  std::snprintf(text, sizeof text, ": no sample for %.2f s at %.2f s; bridged%s", widest_s, at_s,
                gaps > 1 ? ", as other holes are" : "");
  return what + text;
}

}  // namespace phare
