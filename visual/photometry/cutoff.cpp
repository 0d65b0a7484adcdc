#include "visual/photometry/cutoff.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "visual/photometry/cutoff_line.h"

namespace phare {
namespace {

constexpr double kSpan_deg = 0.1;       // of G
constexpr double kRuleStep_deg = 0.05;  // UN R112 annex 9
constexpr double kFineStep_deg = 0.01;
constexpr double kFloorShare = 1e-4;  // of the scan's highest: four decades, more than a photometer holds in one range
constexpr double kFaintShare = 0.02;
constexpr double kLeastG = 0.05;
constexpr double kLeastRuleG = 0.13;  // UN R112 annex 9, FMVSS 108: what the rules accept as a cut-off

/// A straight line through points by least squares.
struct Line {
  double slope = 0.0, offset = 0.0;
  double spread = 0.0;  ///< worst distance of a point
};

Line fit(const std::vector<std::pair<double, double>>& points) {
  const double n = static_cast<double>(points.size());
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const auto& [a, b] : points) {
    x += a / n;
    y += b / n;
  }
  for (const auto& [a, b] : points) {
    xx += (a - x) * (a - x);
    xy += (a - x) * (b - y);
  }
  Line line;
  line.slope = xx > 0.0 ? xy / xx : 0.0;
  line.offset = y - line.slope * x;
  for (const auto& [a, b] : points) line.spread = std::max(line.spread, std::abs(b - line.offset - line.slope * a));
  return line;
}

}  // namespace

namespace {

/// A vertical scan in kFineStep_deg.
struct Scan {
  double from_v_deg = 0.0;
  double highest_cd = 0.0;
  std::vector<double> cd;
  std::vector<Evidence> evidence;
};

/// The steepest 0.1° among samples with no worse evidence than `worst`.
Cutoff steepest(const Scan& scan, Evidence worst) {
  const int steps = static_cast<int>(scan.cd.size()) - 1;
  const int span = static_cast<int>(std::lround(kSpan_deg / kFineStep_deg));
  const int rule_step = static_cast<int>(std::lround(kRuleStep_deg / kFineStep_deg));
  std::vector<int> unknown{0};  // how many of the first i samples are not to be used
  for (const Evidence e : scan.evidence) unknown.push_back(unknown.back() + (e > worst ? 1 : 0));
  const auto known = [&](int i) {
    return i >= 0 && i + span <= steps &&
           unknown[static_cast<std::size_t>(i + span + 1)] == unknown[static_cast<std::size_t>(i)];
  };
  const double floor_cd = kFloorShare * scan.highest_cd;
  const auto g_at = [&](int i) {
    if (!known(i)) return 0.0;
    const double below = scan.cd[static_cast<std::size_t>(i)], above = scan.cd[static_cast<std::size_t>(i + span)];
    if (below < kFaintShare * scan.highest_cd || below <= 0.0) return 0.0;
    return std::log10(std::max(below, floor_cd)) - std::log10(std::max(above, floor_cd));
  };
  Cutoff result;
  double finest = 0.0;
  int best = 0;
  for (int i = 0; i + span <= steps; ++i) {
    const double g = g_at(i);
    if (i % rule_step == 0) result.sharpness_g = std::max(result.sharpness_g, g);
    if (g > finest) {
      finest = g;
      best = i;
    }
  }
  if (finest < kLeastG) return result;
  // On a table with coarse rows G has a flat top: take its middle.
  int first = best, last = best;
  while (first > 0 && g_at(first - 1) >= finest - 1e-6) --first;
  while (last + 1 + span <= steps && g_at(last + 1) >= finest - 1e-6) ++last;
  result.at_edge = !known(first - 1) || !known(last + 1);
  result.found = !result.at_edge;
  if (result.at_edge) return result;
  double middle = 0.5 * (first + last);
  if (first == last) {  // between the steps: the top of a parabola
    const double below = g_at(best - 1), above = g_at(best + 1), bend = below - 2.0 * finest + above;
    if (bend < 0.0) middle += std::clamp(0.5 * (below - above) / bend, -0.5, 0.5);
  }
  result.elevation_deg = scan.from_v_deg + kFineStep_deg * middle + 0.5 * kSpan_deg;
  return result;
}

/// Index of the cell's lower node; false outside the range, whose limits belong to it.
bool cell_of(const std::vector<double>& nodes, double at, std::size_t& index) {
  if (nodes.size() < 2 || !(at >= nodes.front() && at <= nodes.back())) return false;
  index = static_cast<std::size_t>(std::upper_bound(nodes.begin() + 1, nodes.end() - 1, at) - nodes.begin()) - 1;
  return true;
}

}  // namespace

Evidence evidence_of(const IntensityTable& table, const glm::dvec3& direction) {
  const TableAngles angles = table.angles_of(direction);
  std::size_t i = 0, j = 0;
  if (!cell_of(table.first_deg, angles.first_deg, i) || !cell_of(table.second_deg, angles.second_deg, j)) {
    const bool to_both_sides =
        table.type != PhotometricType::kC
            ? !table.first_deg.empty() && table.first_deg.front() <= -90.0 && table.first_deg.back() >= 90.0
            : table.axis == GammaAxis::kGamma0 && !table.second_deg.empty() && table.second_deg.back() >= 90.0;
    return direction.x <= 1e-9 && to_both_sides && table.screen_distance_m <= 0.0 ? Evidence::kDark : Evidence::kNone;
  }
  const double* row = table.candela.data() + j * table.first_deg.size() + i;
  const double* next_row = row + table.first_deg.size();
  return std::min({row[0], row[1], next_row[0], next_row[1]}) > 0.0 ? Evidence::kLit : Evidence::kDark;
}

IntensityHv mounted_intensity(const IntensityTable& table, const glm::dmat3& car_from_lamp, double scale) {
  IntensityHv intensity = [&table, car_from_lamp, scale](double h_deg, double v_deg) {
    return scale * table.intensity_cd(direction_hv(h_deg, v_deg) * car_from_lamp);
  };
  intensity.evidence = [&table, car_from_lamp](double h_deg, double v_deg) {
    return evidence_of(table, direction_hv(h_deg, v_deg) * car_from_lamp);
  };
  return intensity;
}

Cutoff find_cutoff(const IntensityHv& intensity, double h_deg, double from_v_deg, double to_v_deg) {
  const int steps = static_cast<int>(std::lround((to_v_deg - from_v_deg) / kFineStep_deg));
  Scan scan;
  scan.from_v_deg = from_v_deg;
  bool any_dark = false;
  for (int i = 0; i <= steps; ++i) {
    const double v_deg = from_v_deg + kFineStep_deg * i;
    const double cd = intensity(h_deg, v_deg);
    const Evidence evidence = intensity.evidence ? intensity.evidence(h_deg, v_deg)
                              : cd > 0.0         ? Evidence::kLit
                                                 : Evidence::kDark;
    any_dark = any_dark || evidence == Evidence::kDark;
    scan.cd.push_back(cd);
    scan.evidence.push_back(evidence);
    scan.highest_cd = std::max(scan.highest_cd, cd);
  }
  const Cutoff lit = steepest(scan, Evidence::kLit);
  if (!any_dark || (lit.found && lit.sharpness_g >= kLeastRuleG)) return lit;
  const Cutoff dark = steepest(scan, Evidence::kDark);
  return dark.found ? dark : lit;
}

CutoffShape cutoff_shape(const IntensityHv& intensity) {
  CutoffShape shape;
  const Kink kink = find_kink(intensity);  // flat and rising part are looked at beside it, wherever it lies
  const double at[2] = {kink.h_deg - 2.5, kink.h_deg + 2.5};
  std::vector<std::pair<double, double>> sides[2];  // left, right
  for (double from_kink = 1.5; from_kink <= 4.01; from_kink += 0.5) {
    for (const int side : {0, 1}) {
      const double h = kink.h_deg + (side == 0 ? -from_kink : from_kink);
      const Cutoff cutoff = find_cutoff(intensity, h);
      if (cutoff.found) sides[side].emplace_back(h, cutoff.elevation_deg);
    }
  }
  const auto slope_deg = [](const Line& line) { return std::atan(line.slope) * 180.0 / std::numbers::pi; };
  Line lines[2];
  bool straight[2];
  for (const int side : {0, 1}) {
    lines[side] = fit(sides[side]);
    straight[side] = sides[side].size() >= 4 && lines[side].spread < 0.25;
  }
  if (!straight[0] && !straight[1]) return shape;
  constexpr double kFlat_deg = 4.0, kRising_deg = 8.0;                 // halfway to the 15° of UN beams
  const double rise[2] = {-slope_deg(lines[0]), slope_deg(lines[1])};  // outward and up is positive
  const bool flat[2] = {straight[0] && std::abs(rise[0]) < kFlat_deg, straight[1] && std::abs(rise[1]) < kFlat_deg};
  if (!flat[0] && !flat[1]) return shape;
  const int flat_side = flat[0] ? 0 : 1;
  const auto elevation = [&](int side) { return lines[side].offset + lines[side].slope * at[side]; };
  shape.side = CutoffSide::kFlat;
  shape.flat_v_deg = elevation(flat_side);
  shape.sharpness_g = find_cutoff(intensity, at[flat_side]).sharpness_g;
  for (const int side : {0, 1}) {
    const int other = 1 - side;
    if (!flat[other]) continue;
    // A 45° shoulder is at its top within 1.5°: then the other side is flat again, but higher.
    const bool rises = sides[side].size() >= 3 && rise[side] > kRising_deg;
    const bool step = flat[side] && elevation(side) - elevation(other) > 0.25;
    if (!rises && !step) continue;
    shape.side = side == 1 ? CutoffSide::kRisesRight : CutoffSide::kRisesLeft;
    shape.flat_v_deg = elevation(other);
    shape.sharpness_g = find_cutoff(intensity, at[other]).sharpness_g;
    if (kink.found) {
      shape.rise_deg = kink.rise_deg;
      shape.kink_h_deg = kink.h_deg;
    } else if (rises) {
      shape.rise_deg = rise[side];
      shape.kink_h_deg = (lines[other].offset - lines[side].offset) / (lines[side].slope - lines[other].slope);
    }
    break;
  }
  return shape;
}

}  // namespace phare
