#include "visual/photometry/bench/lamp_aim.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace phare {
namespace {

constexpr double kDegPerRad = 180.0 / std::numbers::pi;
constexpr double kBesideKink_deg = 2.5;  // UN R112 annex 9 scans there, on the flat side
constexpr double kNear_deg = 0.003;
constexpr double kLeastAimG = 0.08;  // the least sharpness by which a rule aims anything (UN R149, the 0.2 D line)

/// The sources of one function of a lamp together.
IntensityHv sum_of(const LampConfig& lamp, LampFunction function, const LampTables& tables) {
  std::vector<IntensityHv> parts;
  for (const SourceConfig& source : lamp.sources) {
    if (source.function != function) continue;
    const AimedSource light = tables.aimed(source);
    parts.push_back(mounted_intensity(*light.table, light.car_from_lamp, light.scale));
  }
  if (parts.size() == 1) return parts.front();
  IntensityHv sum;
  sum.evidence = [parts](double h_deg, double v_deg) {
    Evidence best = Evidence::kNone;
    for (const IntensityHv& part : parts) best = std::min(best, part.evidence(h_deg, v_deg));
    return best;
  };
  static_cast<std::function<double(double, double)>&>(sum) = [parts](double h_deg, double v_deg) {
    double cd = 0.0;
    for (const IntensityHv& part : parts) cd += part(h_deg, v_deg);
    return cd;
  };
  return sum;
}

bool has(const LampConfig& lamp, LampFunction function) {
  return std::ranges::any_of(lamp.sources, [&](const SourceConfig& s) { return s.function == function; });
}

/// Elevation of the flat part beside the kink; of a cut-off that is flat to both sides, the mean.
std::optional<double> flat_part_deg(const IntensityHv& beam, const CutoffShape& shape) {
  double sum = 0.0;
  int count = 0;
  for (const double side : {-1.0, 1.0}) {
    if (shape.side == CutoffSide::kRisesRight && side > 0.0) continue;
    if (shape.side == CutoffSide::kRisesLeft && side < 0.0) continue;
    const Cutoff cutoff = find_cutoff(beam, shape.kink_h_deg + side * kBesideKink_deg);
    if (!cutoff.found || cutoff.sharpness_g < kLeastAimG) continue;
    sum += cutoff.elevation_deg;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / count;
}

std::string formatted(const char* format, double a, double b = 0.0, double c = 0.0) {
  char text[200];
  std::snprintf(text, sizeof text, format, a + 0.0, b + 0.0, c + 0.0);
  return text;
}

}  // namespace

AimLine aim_line(LampFunction function, double height_m) {
  if (function == LampFunction::kFog) return {-2.0, -2.5, -1.5, "UN R48 6.3.6.1.2"};
  if (height_m > 1.0) return {-1.5, -2.0, -1.5, "UN R48 6.2.6.1.2"};
  if (height_m > 0.8) return {-1.0, -2.0, -1.0, "UN R48 6.2.6.1.2"};
  return {};
}

double degrees_of_percent(double percent) {
  return std::atan(percent / 100.0) * kDegPerRad;
}
double percent_of_degrees(double degrees) {
  return 100.0 * std::tan(degrees / kDegPerRad);
}

bool LampAiming::within() const {
  constexpr double kOpen_percent = 0.05;  // half the 0.1 % in which R48 6.2.6.1.1 wants the aim stated
  const double percent = percent_of_degrees(after_deg);
  return found && percent >= line.lowest_percent - kOpen_percent && percent <= line.highest_percent + kOpen_percent;
}

std::string beam_name(LampFunction function) {
  switch (function) {
    case LampFunction::kLow:
      return "low beam";
    case LampFunction::kHigh:
      return "high beam";
    case LampFunction::kFog:
      return "fog lamp";
    case LampFunction::kCornering:
      return "cornering lamp";
    case LampFunction::kPosition:
    case LampFunction::kDaytime:
      break;
  }
  return std::string(kLampFunctionNames[static_cast<std::size_t>(function)]) + " lamp";
}

std::string LampAiming::text() const {
  if (asked == AimConfig::Kind::kTurned) return formatted("turned by %+.2f°, as asked", turned_deg);
  if (!found) return "no cut-off found: aimed as filed";
  std::string text;
  if (shape.side == CutoffSide::kFlat) {
    text = formatted("flat cut-off found at V %+.2f°", before_deg) +
           (function == LampFunction::kLow ? ", no kink, so no side of traffic is told" : "");
  } else {
    const bool right = shape.side == CutoffSide::kRisesRight;
    text = formatted("cut-off found at V %+.2f°, ", before_deg);
    // A step has no kink of its own.
    text += shape.rise_deg > 0.0 ? formatted("kink at H %+.2f° rising by %.0f°", shape.kink_h_deg, shape.rise_deg)
                                 : std::string("higher");
    text += right ? " to the right: for right-hand traffic" : " to the left: for left-hand traffic";
  }
  if (asked == AimConfig::Kind::kAsFiled) return text + "; aimed as filed";
  return text + formatted("; turned by %+.2f° to %+.2f° (%.1f %%): ", turned_deg, after_deg, line.line_percent) +
         line.clause +
         formatted(" asks %.1f to %.1f %% of a new lamp %.2f m high", line.highest_percent, line.lowest_percent,
                   height_m);
}

LampAiming aim_lamp(LampConfig& lamp, const LampTables& tables) {
  LampAiming aiming;
  aiming.lamp = lamp.name;
  aiming.asked = lamp.aim.kind;
  aiming.function = has(lamp, LampFunction::kLow) ? LampFunction::kLow : LampFunction::kFog;
  aiming.height_m = lamp.position_m.z;
  aiming.line = aim_line(aiming.function, lamp.position_m.z);
  const auto turn = [&](double up_deg) {
    for (SourceConfig& source : lamp.sources) source.pitch_rad += up_deg / kDegPerRad;
    aiming.turned_deg += up_deg;
  };
  if (lamp.aim.kind == AimConfig::Kind::kTurned) turn(lamp.aim.up_rad * kDegPerRad);
  const bool to_line = lamp.aim.kind == AimConfig::Kind::kCutoff;
  lamp.aim = {};
  if (!has(lamp, aiming.function)) return aiming;  // a driving beam has none to be aimed by

  aiming.shape = cutoff_shape(sum_of(lamp, aiming.function, tables));
  if (aiming.shape.side == CutoffSide::kNone) return aiming;
  const auto elevation = [&] { return flat_part_deg(sum_of(lamp, aiming.function, tables), aiming.shape); };
  std::optional<double> stands_deg = elevation();
  if (!stands_deg) return aiming;
  aiming.found = true;
  aiming.before_deg = *stands_deg;
  const double line_deg = degrees_of_percent(aiming.line.line_percent);
  for (int round = 0; to_line && stands_deg && round < 5 && std::abs(line_deg - *stands_deg) > kNear_deg; ++round) {
    turn(line_deg - *stands_deg);
    stands_deg = elevation();
  }
  aiming.after_deg = stands_deg.value_or(line_deg);
  return aiming;
}

std::vector<LampAiming> aim_lamps(std::vector<DesignConfig>& designs, const LampTables& tables) {
  std::vector<LampAiming> all;
  for (DesignConfig& design : designs) {
    for (LampConfig& lamp : design.lamps) {
      if (lamp.aim.kind == AimConfig::Kind::kAsFiled) continue;
      all.push_back(aim_lamp(lamp, tables));
      all.back().design = design.name;
    }
  }
  return all;
}

}  // namespace phare
