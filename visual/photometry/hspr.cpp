// HSPR of a pair of lamps.
// Computes: field notes §5.4 line by line. Where they leave something open it is said at the place: lateral ray B
// starts at the origin; D and E walk inwards to each side and the width is the mean of both sides (off: the side of
// oncoming traffic, near: one's own); the glare window is sampled 11 × 7 with weights 0.2 / 0.5 / 1 growing towards the
// middle. Source: GTB CE-5815 by way of the field notes. Frame: x right, y up, z ahead. Leaves out: ADB, the system
// mix. Checked by tests/photometry/hspr_test.cpp with sources whose ranges have closed forms.
#include "visual/photometry/hspr.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "visual/photometry/beam_image.h"
#include "visual/photometry/cutoff.h"

namespace phare {
namespace {

constexpr double kFar_m = 400.0, kRangeStep_m = 0.5;
constexpr double kWide_m = 20.0, kWidthStep_m = 0.1;

/// Walks from `from` inwards in steps until E exceeds the threshold; 0 if it never does.
template <typename At>
double walk_in(double from, double step, double threshold_lx, const At& lux_at) {
  for (int i = 0;; ++i) {
    const double at = from - step * i;
    if (at <= 0.0) return 0.0;
    if (lux_at(at) > threshold_lx) return at;
  }
}

double lux(const std::vector<HsprLamp>& lamps, double x, double y, double z) {
  return hspr_illuminance_lx(lamps, x, y, z);
}

/// Mean range over thresholds and lateral places at height y.
double mean_range(const std::vector<HsprLamp>& lamps, std::vector<double> x_m, double y_m,
                  std::vector<double> thresholds_lx) {
  double sum = 0.0;
  for (const double threshold : thresholds_lx) {
    for (const double x : x_m)
      sum += walk_in(kFar_m, kRangeStep_m, threshold, [&](double z) { return lux(lamps, x, y_m, z); });
  }
  return sum / static_cast<double>(x_m.size() * thresholds_lx.size());
}

/// Mean over distances of how far 3 lx reaches to one side (-1 left, +1 right).
double mean_width(const std::vector<HsprLamp>& lamps, std::vector<double> z_m, double y_m, double side) {
  double sum = 0.0;
  for (const double z : z_m)
    sum += walk_in(kWide_m, kWidthStep_m, 3.0, [&](double x) { return lux(lamps, side * x, y_m, z); });
  return sum / static_cast<double>(z_m.size());
}

/// Flux of all lamps into a window of H and V about the car's axis, by the midpoint rule in 0.25°.
double window_flux_lm(const std::vector<HsprLamp>& lamps, double h_deg, double v_low_deg, double v_high_deg) {
  constexpr double kStep = 0.25;
  double sum = 0.0;
  for (const HsprLamp& lamp : lamps) {
    const glm::dmat3 car_from_lamp = aim_rotation(0.0, glm::radians(lamp.aim_up_deg), 0.0);
    for (double v = v_low_deg + 0.5 * kStep; v < v_high_deg; v += kStep) {
      double row = 0.0;
      for (double h = -h_deg + 0.5 * kStep; h < h_deg; h += kStep)
        row += lamp.table->intensity_cd(direction_hv(h, v) * car_from_lamp);
      sum += row * std::cos(glm::radians(v)) * glm::radians(kStep) * glm::radians(kStep);
    }
  }
  return sum;
}

/// Weighted mean illuminance of oncoming eyes: window at 50 m, x -7.9 to 1.3 m, y 0.93 to 1.62 m.
double glare_lx(const std::vector<HsprLamp>& lamps) {
  double sum = 0.0, weights = 0.0;
  for (int i = 0; i <= 10; ++i) {
    for (int j = 0; j <= 6; ++j) {
      const double u = std::abs(i - 5) / 5.0, v = std::abs(j - 3) / 3.0, out = std::max(u, v);
      const double weight = out < 0.34 ? 1.0 : out < 0.67 ? 0.5 : 0.2;
      sum += weight * lux(lamps, -7.9 + 0.92 * i, 0.93 + 0.115 * j, 50.0);
      weights += weight;
    }
  }
  return sum / weights;
}

void conclude(HsprResult& result) {
  for (HsprRow& row : result.rows) {
    if (row.one_point == row.two_points) {
      result.complete = false;
      continue;
    }
    row.points = (row.value - row.one_point) / (row.two_points - row.one_point) + 1.0;
    result.weighted += row.weight * row.points;
  }
  if (result.complete) result.on_scale_01 = (result.weighted - result.worst) / (result.best - result.worst);
}

constexpr const char* kOffIsOncoming = "off taken as the side of oncoming traffic, near as one's own";

}  // namespace

double hspr_illuminance_lx(const std::vector<HsprLamp>& lamps, double x_m, double y_m, double z_m) {
  double sum = 0.0;
  for (const HsprLamp& lamp : lamps) {
    const glm::dvec3 d{z_m, lamp.x_m - x_m, y_m - lamp.y_m};  // ours: ahead, left, up
    const double r2 = d.x * d.x + d.y * d.y + d.z * d.z;
    if (d.x <= 0.0) continue;
    sum += lamp.table->intensity_cd(d * aim_rotation(0.0, glm::radians(lamp.aim_up_deg), 0.0)) * d.x /
           (r2 * std::sqrt(r2));
  }
  return sum;
}

Result<HsprBeam> hspr_beam(std::vector<HsprLamp>& lamps, HsprBeam asked) {
  std::vector<CutoffShape> shapes;
  for (const HsprLamp& lamp : lamps) {
    shapes.push_back(cutoff_shape(mounted_intensity(*lamp.table, glm::dmat3{1.0})));
    if (shapes.back().side == CutoffSide::kRisesLeft)
      return Error{lamp.table->name,
                   "is for left-hand traffic; the method is written for right-hand traffic: turn it with --mirror"};
  }
  const auto kind = [](CutoffSide side) {
    return side == CutoffSide::kRisesRight ? "a passing beam"
           : side == CutoffSide::kFlat     ? "a beam with a flat cut-off"
                                           : "a beam without a cut-off";
  };
  for (std::size_t k = 1; k < lamps.size(); ++k) {
    if (shapes[k].side != shapes[0].side)
      return Error{lamps[k].table->name, std::string("is ") + kind(shapes[k].side) + ", " + lamps[0].table->name +
                                             " is " + kind(shapes[0].side) + ": no pair"};
  }
  const CutoffSide side = shapes.front().side;
  if (asked == HsprBeam::kFind && side == CutoffSide::kFlat)
    return Error{lamps.front().table->name,
                 "has a flat cut-off, as fog lamps have: neither passing nor driving beam; name it with --beam"};
  const bool low = asked == HsprBeam::kLow || (asked == HsprBeam::kFind && side == CutoffSide::kRisesRight);
  for (std::size_t k = 0; k < lamps.size(); ++k)
    lamps[k].aim_up_deg = low && side != CutoffSide::kNone ? -0.573 - shapes[k].flat_v_deg : 0.0;
  return low ? HsprBeam::kLow : HsprBeam::kHigh;
}

HsprResult hspr_low_beam(const std::vector<HsprLamp>& lamps) {
  HsprResult result;
  const double tan_5 = std::tan(glm::radians(5.0));
  double ray = 0.0;
  for (const double threshold : {1.0, 3.0, 5.0}) {
    for (const double x : {0.0, 1.5, 3.0})
      ray +=
          walk_in(kFar_m, kRangeStep_m, threshold, [&](double z) { return lux(lamps, x + z * tan_5, 0.0, z); }) / 9.0;
  }
  result.rows = {
      {"A", "range ahead, 1, 3, 5 lx at x 0, 1.5, 3 m", "m", mean_range(lamps, {0.0, 1.5, 3.0}, 0.0, {1.0, 3.0, 5.0}),
       71.6, 95.1, 0, 1.5},
      {"B", "range along 5 deg right", "m", ray, 71.5, 138.4, 0, 1.0, "rays taken to start at x 0, 1.5, 3 m"},
      {"C", "range on the oncoming side, x -3, -4.5, -6 m, 0.25 m high", "m",
       mean_range(lamps, {-3.0, -4.5, -6.0}, 0.25, {1.0, 3.0, 5.0}), 32.7, 48.4, 0, 1.0},
      {"D off", "3 lx width at 30, 40, 50 m, oncoming side", "m", mean_width(lamps, {30.0, 40.0, 50.0}, 0.0, -1.0), 4.8,
       12.5, 0, 0.75, kOffIsOncoming},
      {"D near", "3 lx width at 30, 40, 50 m, own side", "m", mean_width(lamps, {30.0, 40.0, 50.0}, 0.0, 1.0), 7.6,
       16.3, 0, 0.75, kOffIsOncoming},
      {"E off", "3 lx width at 10, 20 m, 0.25 m high, oncoming side", "m", mean_width(lamps, {10.0, 20.0}, 0.25, -1.0),
       5.9, 9.6, 0, 0.5, kOffIsOncoming},
      {"E near", "3 lx width at 10, 20 m, 0.25 m high, own side", "m", mean_width(lamps, {10.0, 20.0}, 0.25, 1.0), 6.6,
       10.5, 0, 0.5, kOffIsOncoming},
      {"flux", "flux in +-45 deg x -15 to +5 deg", "lm", window_flux_lm(lamps, 45.0, -15.0, 5.0), 747.6, 1785.1, 0,
       1.0},
      {"glare", "weighted illuminance of oncoming eyes at 50 m", "lx", glare_lx(lamps), 0.73, 0.27, 0, 1.0,
       "weights 0.2, 0.5, 1 taken to grow towards the window's middle, sampled 11 x 7"}};
  result.worst = 11.15;
  result.best = 17.61;
  conclude(result);
  return result;
}

HsprResult hspr_high_beam(const std::vector<HsprLamp>& lamps) {
  HsprResult result;
  double height = 0.0;
  for (const HsprLamp& lamp : lamps) height += lamp.y_m / static_cast<double>(lamps.size());
  const struct {
    const char* id;
    double x_m, y_m, weight;
  } rays[] = {{"0, h", 0, height, 2.0},
              {"-20, h", -20, height, 0.8},
              {"0, h+9", 0, height + 9, 0.4},
              {"20, h", 20, height, 0.8},
              {"0, h-2", 0, height - 2, 1.0}};
  for (const auto& ray : rays) {
    const double range = walk_in(kFar_m, kRangeStep_m, 3.0,
                                 [&](double z) { return lux(lamps, ray.x_m * z / 100.0, ray.y_m * z / 100.0, z); });
    result.rows.push_back(
        {ray.id, std::string("3 lx range through (") + ray.id + ") at 100 m", "m", range, 0, 0, 0, ray.weight});
  }
  result.rows.push_back({"E off", "3 lx width at 10, 20 m, 0.25 m high, left", "m",
                         mean_width(lamps, {10.0, 20.0}, 0.25, -1.0), 0, 0, 0, 1.0});
  result.rows.push_back({"E near", "3 lx width at 10, 20 m, 0.25 m high, right", "m",
                         mean_width(lamps, {10.0, 20.0}, 0.25, 1.0), 0, 0, 0, 1.0});
  result.rows.push_back(
      {"flux", "flux in +-45 deg x -5 to +10 deg", "lm", window_flux_lm(lamps, 45.0, -5.0, 10.0), 0, 0, 0, 1.0});
  result.worst = 11.31;
  result.best = 19.23;
  conclude(result);
  return result;
}

}  // namespace phare
