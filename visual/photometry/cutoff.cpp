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
constexpr double kFaintest_cd = 1e-6;  // below, log E has no meaning
constexpr double kFaintShare = 0.02;
constexpr double kLeastG = 0.05;

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

IntensityHv mounted_intensity(const IntensityTable& table, const glm::dmat3& car_from_lamp, double scale) {
  return [&table, car_from_lamp, scale](double h_deg, double v_deg) {
    return scale * table.intensity_cd(direction_hv(h_deg, v_deg) * car_from_lamp);
  };
}

Cutoff find_cutoff(const IntensityHv& intensity, double h_deg, double from_v_deg, double to_v_deg) {
  const int steps = static_cast<int>(std::lround((to_v_deg - from_v_deg) / kFineStep_deg));
  const int span = static_cast<int>(std::lround(kSpan_deg / kFineStep_deg));
  const int rule_step = static_cast<int>(std::lround(kRuleStep_deg / kFineStep_deg));
  std::vector<double> cd;
  double highest = 0.0;
  for (int i = 0; i <= steps; ++i) {
    cd.push_back(intensity(h_deg, from_v_deg + kFineStep_deg * i));
    highest = std::max(highest, cd.back());
  }
  const auto g_at = [&](int i) {
    const double below = cd[static_cast<std::size_t>(i)], above = cd[static_cast<std::size_t>(i + span)];
    if (below < kFaintShare * highest) return 0.0;
    return std::log10(std::max(below, kFaintest_cd)) - std::log10(std::max(above, kFaintest_cd));
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
  result.found = finest >= kLeastG;
  if (!result.found) return result;
  // On a table with coarse rows G has a flat top: take its middle.
  int first = best, last = best;
  while (first > 0 && g_at(first - 1) >= finest - 1e-6) --first;
  while (last + 1 + span <= steps && g_at(last + 1) >= finest - 1e-6) ++last;
  double middle = 0.5 * (first + last);
  if (first == last && best > 0 && best + 1 + span <= steps) {  // between the steps: the top of a parabola
    const double below = g_at(best - 1), above = g_at(best + 1), bend = below - 2.0 * finest + above;
    if (bend < 0.0) middle += std::clamp(0.5 * (below - above) / bend, -0.5, 0.5);
  }
  result.elevation_deg = from_v_deg + kFineStep_deg * middle + 0.5 * kSpan_deg;
  return result;
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
