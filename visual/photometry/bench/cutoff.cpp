#include "visual/photometry/bench/cutoff.h"

#include <algorithm>
#include <cmath>

namespace phare {
namespace {

constexpr double kSpan_deg = 0.1;       // of G
constexpr double kRuleStep_deg = 0.05;  // UN R112 annex 9
constexpr double kFineStep_deg = 0.01;
constexpr double kFloorShare = 1e-4;  // of the scan's highest: four decades, more than a photometer holds in one range
constexpr double kFaintShare = 0.02;
constexpr double kLeastG = 0.05;
constexpr double kWidestRow_deg = 2.0;
constexpr double kLeastRuleG = 0.13;  // UN R112 annex 9, FMVSS 108: what the rules accept as a cut-off

/// A vertical scan in kFineStep_deg.
struct Scan {
  double from_v_deg = 0.0;
  double highest_cd = 0.0;
  std::vector<double> cd;
  std::vector<Evidence> evidence;

  double v_deg(std::size_t i) const { return from_v_deg + kFineStep_deg * static_cast<double>(i); }
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

/// Candela that are linear between rows bend in the logarithm, which draws the steepest 0.1° towards a row's dark end.
/// At the rows themselves log E is known: the mean slopes over so many rows as span 0.1°, and the top of a parabola
/// through the steepest and its neighbours.
void settle_on_rows(const IntensityHv& intensity, double h_deg, const Scan& scan, Evidence worst, Cutoff& cutoff) {
  const auto row_at = [&](double v_deg) { return intensity.row(h_deg, v_deg); };
  const std::size_t row = row_at(cutoff.elevation_deg);
  double below = kFineStep_deg, above = kFineStep_deg;
  while (below < kWidestRow_deg && row_at(cutoff.elevation_deg - below) == row) below += kFineStep_deg;
  while (above < kWidestRow_deg && row_at(cutoff.elevation_deg + above) == row) above += kFineStep_deg;
  const double reach = 3.5 * (below + above) + kSpan_deg;
  struct Row {
    double v_deg, log_e;
    bool bright;
  };
  std::vector<Row> rows;
  for (std::size_t i = 1; i < scan.cd.size(); ++i) {
    double low = scan.v_deg(i - 1), high = scan.v_deg(i);  // the next low is this high to the bit: no row is missed
    if (high < cutoff.elevation_deg - reach) continue;
    if (low > cutoff.elevation_deg + reach) break;
    if (scan.evidence[i] > worst || scan.evidence[i - 1] > worst) {
      if (low > cutoff.elevation_deg) break;
      rows.clear();  // only rows without a gap
      continue;
    }
    const std::size_t lower_row = row_at(low);
    if (row_at(high) == lower_row) continue;
    for (int halving = 0; halving < 10; ++halving) {
      const double middle = 0.5 * (low + high);
      (row_at(middle) == lower_row ? low : high) = middle;
    }
    const double cd = intensity(h_deg, low);
    rows.push_back({low, std::log10(std::max(cd, kFloorShare * scan.highest_cd)), cd >= kFaintShare * scan.highest_cd});
  }
  struct Slope {
    double v_deg, low_v_deg, high_v_deg, per_deg;
  };
  std::vector<Slope> slopes;
  std::size_t top = 0;
  for (std::size_t k = 0, last = 0; k < rows.size(); ++k) {
    while (last < rows.size() && rows[last].v_deg - rows[k].v_deg < kSpan_deg - 1e-4) ++last;
    if (last == rows.size()) break;
    const double span = rows[last].v_deg - rows[k].v_deg;
    slopes.push_back({0.5 * (rows[k].v_deg + rows[last].v_deg), rows[k].v_deg, rows[last].v_deg,
                      (rows[k].log_e - rows[last].log_e) / span});
    if (rows[k].bright && slopes.back().per_deg > slopes[top].per_deg) top = k;
  }
  if (slopes.empty()) return;
  cutoff.elevation_deg = slopes[top].v_deg;
  if (top == 0 || top + 1 == slopes.size()) return;
  const double x0 = slopes[top - 1].v_deg - slopes[top].v_deg, x2 = slopes[top + 1].v_deg - slopes[top].v_deg;
  const double d0 = (slopes[top - 1].per_deg - slopes[top].per_deg) / x0;
  const double d2 = (slopes[top + 1].per_deg - slopes[top].per_deg) / x2;
  const double bend = (d2 - d0) / (x2 - x0);
  if (bend < 0.0) cutoff.elevation_deg += std::clamp(-0.5 * (d0 - bend * x0) / bend, 0.5 * x0, 0.5 * x2);
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
  // On a column the cells to its left and right have no say: so a mirrored table says the same.
  const std::size_t left = angles.first_deg == table.first_deg[i + 1] ? 1 : 0;
  const std::size_t right = angles.first_deg == table.first_deg[i] ? 0 : 1;
  const double* row = table.candela.data() + j * table.first_deg.size() + i;
  const double* next_row = row + table.first_deg.size();
  return std::min({row[left], row[right], next_row[left], next_row[right]}) > 0.0 ? Evidence::kLit : Evidence::kDark;
}

std::size_t row_of(const IntensityTable& table, const glm::dvec3& direction) {
  const TableAngles angles = table.angles_of(direction);
  std::size_t i = 0, j = 0;
  if (!cell_of(table.first_deg, angles.first_deg, i) || !cell_of(table.second_deg, angles.second_deg, j)) return 0;
  return 1 + j + (table.type == PhotometricType::kC ? table.second_deg.size() * i : 0);
}

IntensityHv mounted_intensity(const IntensityTable& table, const glm::dmat3& car_from_lamp, double scale) {
  IntensityHv intensity = [&table, car_from_lamp, scale](double h_deg, double v_deg) {
    return scale * table.intensity_cd(direction_hv(h_deg, v_deg) * car_from_lamp);
  };
  intensity.evidence = [&table, car_from_lamp](double h_deg, double v_deg) {
    return evidence_of(table, direction_hv(h_deg, v_deg) * car_from_lamp);
  };
  intensity.row = [&table, car_from_lamp](double h_deg, double v_deg) {
    return row_of(table, direction_hv(h_deg, v_deg) * car_from_lamp);
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
  Cutoff cutoff = steepest(scan, Evidence::kLit);
  Evidence worst = Evidence::kLit;
  if (any_dark && !(cutoff.found && cutoff.sharpness_g >= kLeastRuleG)) {
    if (const Cutoff dark = steepest(scan, Evidence::kDark); dark.found) {
      cutoff = dark;
      worst = Evidence::kDark;
    }
  }
  if (cutoff.found && intensity.row) settle_on_rows(intensity, h_deg, scan, worst, cutoff);
  return cutoff;
}

IntensityHv mirrored_intensity(const IntensityHv& intensity) {
  IntensityHv mirrored = [intensity](double h_deg, double v_deg) { return intensity(-h_deg, v_deg); };
  if (intensity.evidence)
    mirrored.evidence = [evidence = intensity.evidence](double h_deg, double v_deg) { return evidence(-h_deg, v_deg); };
  if (intensity.row) mirrored.row = [row = intensity.row](double h_deg, double v_deg) { return row(-h_deg, v_deg); };
  return mirrored;
}

}  // namespace phare
