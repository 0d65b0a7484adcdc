// What a cut-off says about its lamp: form, side, flat and upper part.
// Computes: straight lines by the median of all slopes (Theil 1950, Sen 1968: a quarter of the scans may be wrong)
// through the inflections on both sides of the kink, and the steep rises between. Everything is worked out for a beam
// that rises to the right; a rise to the left is that of the mirrored beam, so the two are alike to the bit.
// Source: forms of UN R112 annex 9 and R149 annex 5 (15° elbow; 45° to a shoulder), SAE J1383 (step); the limits
// between the forms are chosen by hand. Frame: H right, V up, degrees. Leaves out: where in the beam the rule's own
// lines lie. Checked by tests/photometry/cutoff_shape_test.cpp.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "visual/photometry/bench/cutoff.h"
#include "visual/photometry/bench/cutoff_line.h"

namespace phare {
namespace {

constexpr double kShapeScan_deg = 0.125;  // between vertical scans
constexpr double kFlatSlope = 0.07;       // 4°: steeper is not level
constexpr double kLeastRise_deg = 0.2;    // 2.5° beyond the kink: half of what the shallowest ramps told have there
constexpr double kAside_deg = 2.5;        // from the kink, where the rules scan
constexpr double kBlur_deg = 8.0;         // what columns and noise take from a slope
constexpr double kSteep = 0.4;            // 22°: halfway from an elbow's 15° to a shoulder's 45°, less the blur
constexpr double kLeastStep_deg = 0.15;   // three rows of the rules' scan
constexpr double kRowsOfStep = 1.5;       // … and so many of the table's
constexpr double kPlanesOfStep = 2.5;     // … and of planes that are so much wider there than beside the kink:
constexpr double kWiderRow = 1.2, kLeastSlant = 0.58;  // 30°: less steep is no slant to a shoulder
constexpr double kLeastBeyond_deg = 1.5;               // so far beyond the kink the upper part has to be seen
constexpr double kMainStep = 1.5;
constexpr double kUprightStep_deg = 55.0;  // halfway from 45° to what 0.1° columns leave of an upright step (65°)
constexpr double kSlopeReach_deg = 0.3;    // a slope is told from this to both sides
constexpr double kScatter_deg = 0.25;      // of the middle scan about a straight cut-off
constexpr double kWithin_deg = 4.0;        // a flat cut-off is looked at within this of H = 0
constexpr double kEnds_deg = 5.0;          // … and its ends out there
// A cut-off falls so much more steeply upwards than the beam does downwards.
constexpr double kSpotRatio = 1.5, kSpotRatioOfInflection = 1.3;

using Points = std::vector<std::array<double, 2>>;

double middle_of(std::vector<double>& values) {
  const std::size_t half = values.size() / 2;
  std::sort(values.begin(), values.end());
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

struct MedianLine {
  double slope = 0.0, offset = 0.0;
  double scatter = 0.0;  ///< median distance of a point
  double at(double h_deg) const { return offset + slope * h_deg; }
  bool flat() const { return std::abs(slope) < kFlatSlope && scatter < kScatter_deg; }
};

std::optional<MedianLine> median_line(const Points& points, std::size_t least) {
  if (points.size() < std::max<std::size_t>(least, 2)) return std::nullopt;
  std::vector<double> values;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j)
      values.push_back((points[j][1] - points[i][1]) / (points[j][0] - points[i][0]));
  }
  MedianLine line;
  line.slope = middle_of(values);
  values.clear();
  for (const auto& [h, v] : points) values.push_back(v - line.slope * h);
  line.offset = middle_of(values);
  values.clear();
  for (const auto& [h, v] : points) values.push_back(std::abs(v - line.at(h)));
  line.scatter = middle_of(values);
  return line;
}

Points between(const CutoffLine& line, double from_deg, double to_deg) {
  Points points;
  for (std::size_t i = 0; i < line.h_deg.size(); ++i) {
    if (line.h_deg[i] >= from_deg - 1e-9 && line.h_deg[i] <= to_deg + 1e-9)
      points.push_back({line.h_deg[i], line.v_deg[i]});
  }
  return points;
}

/// Height at H by the median of the scans about it.
std::optional<double> level_at(const CutoffLine& line, double from_deg, double to_deg) {
  std::vector<double> values;
  for (const auto& [h, v] : between(line, from_deg, to_deg)) values.push_back(v);
  if (values.empty()) return std::nullopt;
  return middle_of(values);
}

/// Slope about every point of the line, by least squares within kSlopeReach_deg.
std::vector<double> slopes_along(const CutoffLine& line) {
  std::vector<double> slopes(line.h_deg.size(), 0.0);
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (std::size_t k = 0; k < slopes.size(); ++k) {
      const double d = line.h_deg[k] - line.h_deg[i];
      if (std::abs(d) > kSlopeReach_deg + 1e-9) continue;
      n += 1, x += d, y += line.v_deg[k], xx += d * d, xy += d * line.v_deg[k];
    }
    const double spread = n * xx - x * x;
    if (n >= 3 && spread > 1e-9) slopes[i] = (n * xy - x * y) / spread;
  }
  return slopes;
}

/// Height of the table's row at a direction, where that is known.
double row_height_deg(const IntensityHv& intensity, double h_deg, double v_deg) {
  if (!intensity.row) return 0.0;
  const std::size_t row = intensity.row(h_deg, v_deg);
  double height = 0.0;
  for (const double side : {-0.02, 0.02}) {
    for (int i = 1; i < 100 && intensity.row(h_deg, v_deg + side * i) == row; ++i) height += std::abs(side);
  }
  return height;
}

/// The steep rises of a line, from left to right; lower ones than `least_deg` are none.
std::vector<CutoffStep> steep_rises(const CutoffLine& line, double least_deg) {
  const std::vector<double> slopes = slopes_along(line);
  std::vector<CutoffStep> steps;
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    if (slopes[i] <= kSteep) continue;
    std::size_t last = i;
    while (last + 1 < slopes.size() && slopes[last + 1] > kSteep) ++last;
    const double from = line.h_deg[i], to = line.h_deg[last];
    i = last;
    // The levels beside it, then where the line passes a tenth and nine tenths of the way: foot and head.
    const auto below = level_at(line, from - 2.0 * kSlopeReach_deg, from - 0.05);
    const auto above = level_at(line, to + 0.05, to + 2.0 * kSlopeReach_deg);
    if (!below || !above || *above - *below < least_deg) continue;
    CutoffStep step{from, to, *above - *below};
    const Points on_it = between(line, from - kSlopeReach_deg, to + kSlopeReach_deg);
    for (std::size_t k = 0; k + 1 < on_it.size(); ++k) {
      const auto passes = [&](double share_01, double& h_deg) {
        const double v = *below + share_01 * step.height_deg;
        const double rise = on_it[k + 1][1] - on_it[k][1];
        if (on_it[k][1] <= v && on_it[k + 1][1] > v)
          h_deg = on_it[k][0] + (v - on_it[k][1]) / rise * (on_it[k + 1][0] - on_it[k][0]);
      };
      passes(0.1, step.foot_h_deg);
      passes(0.9, step.head_h_deg);
    }
    steps.push_back(step);
  }
  return steps;
}

/// Planes C lie the farther apart the farther they are from the axis: a slant across them shows as steps from plane to
/// plane, where the rows beside the kink are narrow yet.
bool is_of_planes(const IntensityHv& intensity, const CutoffLine& line, const CutoffStep& step, double kink_row_deg) {
  double row_deg = 0.0;
  for (const double h : {step.foot_h_deg, step.head_h_deg}) {
    if (const auto v = level_at(line, h - 0.5 * kShapeScan_deg, h + 0.5 * kShapeScan_deg))
      row_deg = std::max(row_deg, row_height_deg(intensity, h, *v));
  }
  const double slope = 0.8 * step.height_deg / std::max(1e-3, step.head_h_deg - step.foot_h_deg);
  return row_deg > kWiderRow * kink_row_deg && (step.height_deg < kPlanesOfStep * row_deg || slope < kLeastSlant);
}

/// Does the light fall upwards only as it falls downwards too? So does a spot, whose log E has its inflection nowhere
/// or where stray light takes over.
bool falls_like_a_spot(const IntensityHv& intensity, double h_deg) {
  const Cutoff cutoff = find_cutoff(intensity, h_deg);
  if (!cutoff.found) return false;
  const auto known = [&](double v) { return !intensity.evidence || intensity.evidence(h_deg, v) == Evidence::kLit; };
  const auto fall = [&](double from_v, double to_v) {
    if (!known(from_v) || !known(to_v)) return 0.0;
    const double from = intensity(h_deg, from_v), to = intensity(h_deg, to_v);
    return from > 0.0 && to > 0.0 ? std::log10(from / to) : 0.0;
  };
  double beyond = 0.0;
  for (double v = cutoff.elevation_deg + 0.1; v < cutoff.elevation_deg + 1.0; v += 0.05)
    beyond = std::max(beyond, fall(v, v + 0.1));
  double peak_v = cutoff.elevation_deg, peak_cd = 0.0;
  for (double v = -6.0; v < cutoff.elevation_deg; v += 0.05) {
    if (const double cd = intensity(h_deg, v); cd > peak_cd) peak_cd = cd, peak_v = v;
  }
  // Without an inflection it is faint light that ends the scan, upwards as downwards. With one, which a floor under a
  // spot makes too, only the bright part below is compared: the end of the foreground is a sharp edge in some beams.
  const bool inflection = beyond < 0.95 * cutoff.sharpness_g;
  double down = 0.0;
  for (double v = peak_v; v > peak_v - 6.0; v -= 0.05) {
    if (intensity(h_deg, v) < (inflection ? 0.2 : 0.02) * peak_cd) break;
    down = std::max(down, fall(v, v - 0.1));
  }
  return cutoff.sharpness_g < (inflection ? kSpotRatioOfInflection : kSpotRatio) * down;
}

/// Lines to the left and right of H = c that are each other's mirror image: the mean distance, and how far the ends
/// lie below the middle. `c` that fits best.
struct Symmetry {
  double apart_deg = 1e30, fall_deg = 0.0;
  bool falls() const { return fall_deg >= kLeastRise_deg && apart_deg < 0.5 * fall_deg; }
};

Symmetry symmetry_of(const CutoffLine& line) {
  Symmetry best;
  for (double centre = -3.0; centre <= 3.01; centre += 0.25) {
    double squares = 0.0, pairs = 0.0;
    for (double d = 0.5; d <= kEnds_deg + 0.01; d += 0.25) {
      const auto left = level_at(line, centre - d, centre - d), right = level_at(line, centre + d, centre + d);
      if (!left || !right) continue;
      squares += (*left - *right) * (*left - *right);
      pairs += 1.0;
    }
    if (pairs < 12.0 || std::sqrt(squares / pairs) >= best.apart_deg) continue;
    best.apart_deg = std::sqrt(squares / pairs);
    const auto middle = level_at(line, centre - 1.0, centre + 1.0);
    const auto left = level_at(line, centre - kEnds_deg - 1.0, centre - kEnds_deg + 0.5);
    const auto right = level_at(line, centre + kEnds_deg - 0.5, centre + kEnds_deg + 1.0);
    best.fall_deg = middle && left && right ? *middle - std::max(*left, *right) : 0.0;
  }
  return best;
}

double degrees_of(double slope) {
  return std::atan(slope) * 180.0 / std::numbers::pi;
}

/// A beam that rises to the right at `kink`; none if what is beside it is not level and then higher.
std::optional<CutoffShape> rising_shape(const IntensityHv& intensity, double kink_h_deg, double rise_deg) {
  const CutoffLine line = cutoff_line(intensity, kink_h_deg - 5.0, kink_h_deg + 6.0, kShapeScan_deg);
  CutoffShape shape;
  shape.side = CutoffSide::kRisesRight;
  shape.kink_h_deg = kink_h_deg;
  shape.rise_deg = rise_deg;
  // On wide rows a slant shows as steps from row to row.
  const auto foot_v_deg = level_at(line, kink_h_deg - 2.0, kink_h_deg - 0.5);
  const double row_deg = foot_v_deg ? row_height_deg(intensity, kink_h_deg - 1.0, *foot_v_deg) : 0.0;
  shape.steps = steep_rises(line, std::max(kLeastStep_deg, kRowsOfStep * row_deg));
  std::erase_if(shape.steps, [&](const CutoffStep& s) { return is_of_planes(intensity, line, s, row_deg); });
  // What lies beyond the shoulder is no step of the kink's.
  std::erase_if(shape.steps, [&](const CutoffStep& s) { return std::abs(s.foot_h_deg - kink_h_deg) > 4.0; });
  double foot = kink_h_deg, head = kink_h_deg;
  if (!shape.steps.empty()) {
    foot = std::min(foot, shape.steps.front().foot_h_deg);
    head = std::max(head, shape.steps.back().head_h_deg);
  }
  const auto flat = median_line(between(line, foot - 4.5, foot - 0.25), 6);
  if (!flat || !flat->flat()) return std::nullopt;
  const Points beyond = between(line, head + 0.25, std::max(head + 1.5, kink_h_deg + 5.0));
  const auto upper = median_line(beyond, 6);
  if (!upper || beyond.back()[0] < kink_h_deg + kLeastBeyond_deg) return std::nullopt;
  if (shape.steps.size() >= 2) {  // the kink is the first step's, unless another is much the higher
    const CutoffStep* main = &shape.steps.front();
    for (const CutoffStep& step : shape.steps) {
      if (step.height_deg > kMainStep * main->height_deg) main = &step;
    }
    kink_h_deg = shape.kink_h_deg = main->foot_h_deg;
  }
  shape.flat_v_deg = flat->at(kink_h_deg - kAside_deg);
  shape.upper_v_deg = upper->at(kink_h_deg + kAside_deg);
  if (upper->at(std::max(head, kink_h_deg + kAside_deg)) - flat->at(kink_h_deg) < kLeastRise_deg) return std::nullopt;
  shape.sharpness_g = find_cutoff(intensity, kink_h_deg - kAside_deg).sharpness_g;
  if (shape.steps.size() >= 2) {
    shape.form = CutoffForm::kDoubleStep;
  } else if (shape.steps.size() == 1) {
    const CutoffStep& step = shape.steps.front();
    const double steep_deg = degrees_of(0.8 * step.height_deg / std::max(1e-3, step.head_h_deg - step.foot_h_deg));
    shape.form = std::max(steep_deg, rise_deg) >= kUprightStep_deg ? CutoffForm::kStep : CutoffForm::kZ;
    // The shortest ramp that find_kink tries is wider than an upright step.
    if (shape.form == CutoffForm::kStep) shape.kink_h_deg = step.foot_h_deg;
  } else {
    shape.form = rise_deg >= kUprightStep_deg                ? CutoffForm::kStep
                 : rise_deg > degrees_of(kSteep) + kBlur_deg ? CutoffForm::kZ
                                                             : CutoffForm::kElbow;
  }
  return shape;
}

/// Level on both sides of H = 0, or on the one side that can be told.
std::optional<CutoffShape> flat_shape(const IntensityHv& intensity, const CutoffLine& line, const Symmetry& symmetry) {
  const auto whole = median_line(between(line, -kWithin_deg, kWithin_deg), 20);
  CutoffShape shape;
  shape.side = CutoffSide::kFlat;
  shape.form = CutoffForm::kFlat;
  if (whole && whole->flat()) {
    shape.flat_v_deg = whole->offset;
  } else {
    const auto left = median_line(between(line, -kWithin_deg, -1.5), 6);
    const auto right = median_line(between(line, 1.5, kWithin_deg), 6);
    const bool left_flat = left && left->flat(), right_flat = right && right->flat();
    if (!left_flat && !right_flat) return std::nullopt;
    shape.flat_v_deg = left_flat && right_flat ? 0.5 * (left->at(-kAside_deg) + right->at(kAside_deg))
                       : left_flat             ? left->at(-kAside_deg)
                                               : right->at(kAside_deg);
  }
  shape.upper_v_deg = shape.flat_v_deg;
  shape.sharpness_g =
      std::max(find_cutoff(intensity, -kAside_deg).sharpness_g, find_cutoff(intensity, kAside_deg).sharpness_g);
  if (symmetry.falls()) shape.form = CutoffForm::kSymmetric;
  return shape;
}

}  // namespace

std::string form_name(CutoffForm form) {
  switch (form) {
    case CutoffForm::kNone:
      return "none";
    case CutoffForm::kFlat:
      return "flat";
    case CutoffForm::kSymmetric:
      return "symmetric";
    case CutoffForm::kElbow:
      return "elbow";
    case CutoffForm::kZ:
      return "Z";
    case CutoffForm::kStep:
      return "step";
    case CutoffForm::kDoubleStep:
      break;
  }
  return "double step";
}

std::string side_source(const CutoffShape& shape) {
  return shape.tells_side() ? "by the cut-off" : "assumed: " + why_no_side(shape);
}

std::string why_no_side(const CutoffShape& shape) {
  return shape.side == CutoffSide::kNone        ? "no cut-off tells the side"
         : shape.form == CutoffForm::kSymmetric ? "the cut-off is symmetric"
                                                : "the cut-off is flat";
}

CutoffShape cutoff_shape(const IntensityHv& intensity) {
  int spots = 0;
  for (const double h : {-kAside_deg, 0.0, kAside_deg}) spots += falls_like_a_spot(intensity, h) ? 1 : 0;
  if (spots >= 2) return {};
  const CutoffLine line = cutoff_line(intensity, -8.0, 8.0, 0.25);
  const Symmetry symmetry = symmetry_of(line);
  if (const Kink kink = find_kink(intensity, line); kink.found) {
    const double h = kink.to_right ? kink.h_deg : 0.0 - kink.h_deg;
    auto shape = rising_shape(kink.to_right ? intensity : mirrored_intensity(intensity), h, kink.rise_deg);
    // Two ends that fall alike are no rise.
    if (shape && symmetry.falls() && symmetry.apart_deg < 0.3 * (shape->upper_v_deg - shape->flat_v_deg)) shape.reset();
    if (shape && !kink.to_right) {
      shape->side = CutoffSide::kRisesLeft;
      shape->kink_h_deg = 0.0 - shape->kink_h_deg;
      for (CutoffStep& step : shape->steps) {
        step.foot_h_deg = 0.0 - step.foot_h_deg;
        step.head_h_deg = 0.0 - step.head_h_deg;
      }
    }
    if (shape) return std::move(*shape);
  }
  if (auto shape = flat_shape(intensity, line, symmetry)) return std::move(*shape);
  return {};
}

}  // namespace phare
