#include "visual/photometry/bench/cutoff_line.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <limits>

#include "visual/photometry/beam/beam_image.h"

namespace phare {
namespace {

constexpr double kWindow_deg = 3.0;      // on each side of a kink: short of the shoulder of UN beams
constexpr double kLeastKink_deg = 0.03;  // rms by which the best straight line misses the cut-off; a 15° kink: 0.12°
constexpr double kScan_deg = 0.01;       // what a scan may be off by
constexpr double kLeastRise = 0.09;      // slope of the ramp: 5°
constexpr double kRuleRow_deg = 0.051;   // UN R112 annex 9 scans in 0.05°
constexpr double kOneBeam_log = 0.01;    // 2.3 %: two files of one beam
constexpr double kRamps_deg[] = {0.3, 0.45, 0.6, 0.75, 0.9, 1.2, 1.6, 2.2, kWindow_deg};

/// Straight line plus ramp: v = offset + slope·x + rise·clamp(x, 0, length), x outward from the foot.
struct RampFit {
  double slope = 0.0, rise = 0.0;
  double line_ms = 0.0;  ///< mean square distance of the best line without a ramp
  double ramp_ms = std::numeric_limits<double>::max();
  /// How much better the ramp explains the points than a line, against the scatter of scans.
  double gain() const { return std::log((line_ms + kScan_deg * kScan_deg) / (ramp_ms + kScan_deg * kScan_deg)); }
};

/// Points of a line within the window about a foot; x grows to the right.
std::vector<std::array<double, 2>> window(const CutoffLine& line, double foot_deg) {
  std::vector<std::array<double, 2>> points;
  for (std::size_t i = 0; i < line.h_deg.size(); ++i) {
    const double x = line.h_deg[i] - foot_deg;
    if (std::abs(x) <= kWindow_deg + 1e-9) points.push_back({x, line.v_deg[i]});
  }
  return points;
}

RampFit fit_ramp(const std::vector<std::array<double, 2>>& points, double length_deg) {
  RampFit fit;
  const double n = static_cast<double>(points.size());
  glm::dmat3 m(0.0);
  glm::dvec3 right(0.0);
  double vv = 0.0;
  for (const auto& [x, v] : points) {
    const glm::dvec3 basis{1.0, x, std::clamp(x, 0.0, length_deg)};
    for (int i = 0; i < 3; ++i) m[i] += basis * basis[i];
    right += basis * v;
    vv += v * v;
  }
  const double det2 = m[0][0] * m[1][1] - m[1][0] * m[0][1];
  const double det3 = glm::determinant(m);
  if (!(det2 > 1e-9) || !(std::abs(det3) > 1e-9)) return fit;
  const double b = (m[0][0] * right.y - m[0][1] * right.x) / det2, a = (right.x - m[1][0] * b) / m[0][0];
  fit.line_ms = std::max(0.0, (vv - a * right.x - b * right.y) / n);
  const glm::dvec3 s = glm::inverse(m) * right;
  fit.slope = s.y;
  fit.rise = s.z;
  fit.ramp_ms = std::max(0.0, (vv - (s.x * right.x + s.y * right.y + s.z * right.z)) / n);
  return fit;
}

struct Found {
  double foot_deg = 0.0;
  RampFit fit;
};

/// Best foot of a rise to the right. `fixed_window`: all feet are judged by the points about this place, else each by
/// its own.
Found search(const CutoffLine& line, double from_deg, double to_deg, double step_deg, const double* fixed_window) {
  Found best;
  const auto fixed = fixed_window != nullptr ? window(line, *fixed_window) : std::vector<std::array<double, 2>>{};
  for (double foot = from_deg; foot <= to_deg + 1e-9; foot += step_deg) {
    auto points = fixed_window != nullptr ? fixed : window(line, foot);
    if (fixed_window != nullptr) {
      for (auto& p : points) p[0] -= foot - *fixed_window;
    }
    const auto beyond = std::count_if(points.begin(), points.end(), [](const auto& p) { return p[0] > 0.0; });
    if (beyond < 5 || static_cast<std::ptrdiff_t>(points.size()) - beyond < 5) continue;
    for (const double length : kRamps_deg) {
      const RampFit fit = fit_ramp(points, length);
      // The rising side is the steep one; the other way round the same bend would be a fall that ends.
      if (fit.rise < kLeastRise || fit.slope + fit.rise < std::abs(fit.slope)) continue;
      if (fit.gain() > best.fit.gain()) best = {foot, fit};
    }
  }
  return best;
}

CutoffLine mirrored_line(const CutoffLine& line) {
  CutoffLine mirrored;
  for (std::size_t i = line.h_deg.size(); i-- > 0;) {
    mirrored.h_deg.push_back(0.0 - line.h_deg[i]);
    mirrored.v_deg.push_back(line.v_deg[i]);
  }
  return mirrored;
}

double value_at(const CutoffLine& line, double h_deg) {
  const auto above = std::upper_bound(line.h_deg.begin(), line.h_deg.end(), h_deg);
  if (above == line.h_deg.begin() || above == line.h_deg.end()) return std::numeric_limits<double>::quiet_NaN();
  const std::size_t i = static_cast<std::size_t>(above - line.h_deg.begin());
  const double low = line.h_deg[i - 1], high = line.h_deg[i];
  if (high - low > 0.5) return std::numeric_limits<double>::quiet_NaN();  // a gap in the cut-off
  const double t = (h_deg - low) / (high - low);
  return line.v_deg[i - 1] + t * (line.v_deg[i] - line.v_deg[i - 1]);
}

/// Height of the table's cell at a direction, degrees of elevation; 0 outside the table.
double cell_height_deg(const IntensityTable& table, double h_deg, double v_deg) {
  const TableAngles at = table.angles_of(direction_hv(h_deg, v_deg));
  const auto cell = [](const std::vector<double>& nodes, double x, double& low, double& high) {
    const auto above = std::upper_bound(nodes.begin(), nodes.end(), x);
    if (above == nodes.begin() || above == nodes.end()) return false;
    low = *(above - 1);
    high = *above;
    return true;
  };
  double first[2], second[2];
  if (!cell(table.first_deg, at.first_deg, first[0], first[1]) ||
      !cell(table.second_deg, at.second_deg, second[0], second[1]))
    return 0.0;
  double lowest = 90.0, highest = -90.0;
  for (const double a : first) {
    for (const double b : second) {
      const double z = std::clamp(table.direction_of({a, b}).z, -1.0, 1.0);
      lowest = std::min(lowest, glm::degrees(std::asin(z)));
      highest = std::max(highest, glm::degrees(std::asin(z)));
    }
  }
  return highest - lowest;
}

bool has_data(const IntensityHv& intensity, double h_deg, double v_deg) {
  return !intensity.evidence || intensity.evidence(h_deg, v_deg) != Evidence::kNone;
}

/// One Gauss-Newton step of log E of B onto log E of A in a band about A's cut-off. A difference in level is free, and
/// one in contrast or sharpness is mostly odd about the line and moves it little.
struct BandStep {
  glm::dvec2 turn_deg{0.0};  ///< right, up
  double rms_log = 0.0;      ///< what of log10 E differs before the step, level aside
};
BandStep band_step(const IntensityHv& a, const IntensityHv& b, const CutoffLine& line, bool sideways) {
  constexpr double kBand_deg = 0.75, kBandStep_deg = 0.05, kProbe_deg = 0.05;
  const auto log_cd = [](double cd) { return std::log10(std::max(cd, 1.0)); };
  glm::dmat3 m(0.0);
  glm::dvec3 r(0.0);
  double squares = 0.0;
  for (std::size_t i = 0; i < line.h_deg.size(); i += 2) {
    const double h = line.h_deg[i];
    for (double off = -kBand_deg; off <= kBand_deg + 1e-9; off += kBandStep_deg) {
      const double v = line.v_deg[i] + off;
      if (!has_data(a, h, v) || !has_data(b, h, v - kProbe_deg) || !has_data(b, h, v + kProbe_deg) ||
          !has_data(b, h - kProbe_deg, v) || !has_data(b, h + kProbe_deg, v))
        continue;
      const double up = (log_cd(b(h, v - kProbe_deg)) - log_cd(b(h, v + kProbe_deg))) / (2.0 * kProbe_deg);
      const double right =
          sideways ? (log_cd(b(h - kProbe_deg, v)) - log_cd(b(h + kProbe_deg, v))) / (2.0 * kProbe_deg) : 0.0;
      const glm::dvec3 slope{right, up, 1.0};
      for (int k = 0; k < 3; ++k) m[k] += slope * slope[k];
      const double off_log = log_cd(a(h, v)) - log_cd(b(h, v));
      r += slope * off_log;
      squares += off_log * off_log;
    }
  }
  const double n = m[2][2];
  if (n < 10.0) return {};
  if (!sideways) m[0][0] = 1.0;
  if (!(std::abs(glm::determinant(m)) > 1e-9)) return {};
  const glm::dvec3 step = glm::inverse(m) * r;
  return {{step.x, step.y}, std::sqrt(std::max(0.0, squares / n - r.z / n * (r.z / n)))};
}

bool kinked(const CutoffShape& shape) {
  return shape.side == CutoffSide::kRisesRight || shape.side == CutoffSide::kRisesLeft;
}

}  // namespace

CutoffLine cutoff_line(const IntensityHv& intensity, double from_h_deg, double to_h_deg, double step_deg) {
  CutoffLine line;
  const int steps = static_cast<int>(std::lround((to_h_deg - from_h_deg) / step_deg));
  for (int i = 0; i <= steps; ++i) {
    const double h = from_h_deg + step_deg * i;
    const Cutoff cutoff = find_cutoff(intensity, h);
    if (!cutoff.found) continue;
    line.h_deg.push_back(h);
    line.v_deg.push_back(cutoff.elevation_deg);
  }
  return line;
}

Kink find_kink(const IntensityHv& intensity) {
  return find_kink(intensity, cutoff_line(intensity, -kKinkScan_deg, kKinkScan_deg, kKinkScanStep_deg));
}

Kink find_kink(const IntensityHv& intensity, const CutoffLine& coarse) {
  // Everything is worked out for a rise to the right; a rise to the left is that of the mirrored beam. So the two are
  // alike to the bit, and a beam that is its own mirror image has no kink.
  const Found right = search(coarse, -4.0, 4.0, 0.125, nullptr);
  const Found left = search(mirrored_line(coarse), -4.0, 4.0, 0.125, nullptr);
  Kink kink;
  if (right.fit.gain() == left.fit.gain()) return kink;
  kink.to_right = right.fit.gain() > left.fit.gain();
  Found best = kink.to_right ? right : left;
  const double least = kLeastKink_deg * kLeastKink_deg;
  if (best.fit.ramp_ms > 0.5 * best.fit.line_ms || best.fit.line_ms - best.fit.ramp_ms < least) return kink;
  // Closer: the place is now the one whose ramp its own surroundings lie on best.
  const IntensityHv rising = kink.to_right ? intensity : mirrored_intensity(intensity);
  const CutoffLine fine = cutoff_line(rising, best.foot_deg - 3.5, best.foot_deg + 3.5, 0.1);
  for (const double step : {0.05, 0.01}) {
    const double centre = best.foot_deg;
    const double reach = step > 0.02 ? 0.5 : 0.06;
    const Found closer = search(fine, centre - reach, centre + reach, step, &centre);
    if (closer.fit.ramp_ms > 1e300) return kink;
    best = closer;
  }
  kink.found = true;
  kink.h_deg = kink.to_right ? best.foot_deg : 0.0 - best.foot_deg;
  kink.rise_deg = glm::degrees(std::atan(best.fit.slope + best.fit.rise));
  return kink;
}

LineShift align_lines(const CutoffLine& a, const CutoffLine& b, double a_kink_h_deg, double start_right_deg,
                      double reach_deg) {
  struct Cost {
    double apart_deg = std::numeric_limits<double>::max(), up_deg = 0.0;
  };
  const auto cost = [&](double right_deg) {
    Cost result;
    std::vector<double> off;
    std::size_t asked = 0;
    for (std::size_t i = 0; i < a.h_deg.size(); ++i) {
      if (std::abs(a.h_deg[i] - a_kink_h_deg) > 5.0) continue;
      ++asked;
      const double v = value_at(b, a.h_deg[i] - right_deg);
      if (!std::isnan(v)) off.push_back(a.v_deg[i] - v);
    }
    if (off.size() < 10 || off.size() < asked / 2) return result;
    constexpr double kBeside_deg = 0.25;  // a scan further off took another edge for the cut-off
    const auto middle = off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2);
    std::nth_element(off.begin(), middle, off.end());
    result.up_deg = *middle;
    result.apart_deg = 0.0;
    for (const double d : off)
      result.apart_deg += std::min(std::abs(d - result.up_deg), kBeside_deg) / static_cast<double>(off.size());
    return result;
  };
  double best_right = start_right_deg;
  Cost best = cost(best_right);
  for (const double step : {0.05, 0.01, 0.002}) {
    const double centre = best_right, reach = step > 0.02 ? reach_deg : 6.0 * step;
    for (double right = centre - reach; right <= centre + reach + 1e-9; right += step) {
      const Cost here = cost(right);
      if (here.apart_deg < best.apart_deg - 1e-9) {
        best = here;
        best_right = right;
      }
    }
  }
  // Half a degree to either side must lay the lines visibly further apart; else they slide along each other.
  constexpr double kVisible_deg = 0.01;
  LineShift shift;
  shift.right_known =
      std::min(cost(best_right - 0.5).apart_deg, cost(best_right + 0.5).apart_deg) > best.apart_deg + kVisible_deg;
  if (!shift.right_known) best = cost(0.0);
  shift.right_deg = shift.right_known ? best_right : 0.0;
  shift.up_deg = best.apart_deg < 1e300 ? best.up_deg : 0.0;
  shift.apart_deg = best.apart_deg < 1e300 ? best.apart_deg : 0.0;
  return shift;
}

CutoffAlignment align_cutoffs(const IntensityTable& a, const IntensityTable& b, const CutoffShape& shape_a,
                              const CutoffShape& shape_b) {
  CutoffAlignment result;
  if (shape_a.side == CutoffSide::kNone || shape_b.side == CutoffSide::kNone) return result;
  result.aligned = true;
  const bool both = kinked(shape_a) && kinked(shape_b);
  result.other_side = both && shape_a.side != shape_b.side;
  result.up_deg = shape_a.flat_v_deg - shape_b.flat_v_deg;
  result.right_deg = both ? shape_a.kink_h_deg - shape_b.kink_h_deg : 0.0;
  result.right_known = both;
  if (result.other_side) return result;
  const double centre = kinked(shape_a) ? shape_a.kink_h_deg : 0.0;
  const CutoffLine line_a = cutoff_line(mounted_intensity(a, glm::dmat3{1.0}), centre - 5.0, centre + 5.0, 0.1);
  // Angles add up only near the axis: turn B as a lamp is turned, look again.
  for (const double reach : {0.6, 0.1}) {
    const IntensityHv turned =
        mounted_intensity(b, aim_rotation(-glm::radians(result.right_deg), glm::radians(result.up_deg), 0.0));
    const CutoffLine line_b = cutoff_line(turned, centre - 6.0, centre + 6.0, 0.1);
    const LineShift shift = align_lines(line_a, line_b, centre, 0.0, both ? reach : 0.0);
    if (reach > 0.5) result.right_known = both && shift.right_known;
    result.right_deg = result.right_known ? result.right_deg + shift.right_deg : 0.0;
    result.up_deg += shift.up_deg;
    result.apart_deg = shift.apart_deg;
  }
  const double rise = glm::radians(std::clamp(shape_a.rise_deg, 5.0, 45.0));
  const double row_deg = std::max(cell_height_deg(a, centre - 2.5, shape_a.flat_v_deg),
                                  cell_height_deg(b, centre - 2.5 - result.right_deg, shape_b.flat_v_deg));
  result.up_open_deg = row_deg;  // half a row for each of the two
  result.right_open_deg = result.right_known ? row_deg / std::tan(rise) : 0.0;
  // The steepest place of an interpolated table jumps from row to row. Within what that leaves open, the light about
  // the cut-off decides: where rows are wider than the rules scan, and between copies of one beam, where it is exact.
  const glm::dvec2 at{result.right_deg, result.up_deg};
  const glm::dvec2 open{result.right_open_deg, result.up_open_deg};
  glm::dvec2 turn = at;
  double rms_log = 0.0;
  for (int round = 0; round < 6; ++round) {
    const IntensityHv turned = mounted_intensity(b, aim_rotation(-glm::radians(turn.x), glm::radians(turn.y), 0.0));
    const BandStep step = band_step(mounted_intensity(a, glm::dmat3{1.0}), turned, line_a, result.right_known);
    rms_log = step.rms_log;
    turn = glm::clamp(turn + glm::clamp(step.turn_deg, glm::dvec2(-0.2), glm::dvec2(0.2)), at - open, at + open);
  }
  if (row_deg > kRuleRow_deg || rms_log < kOneBeam_log) {
    result.right_deg = turn.x;
    result.up_deg = turn.y;
  }
  return result;
}

}  // namespace phare
