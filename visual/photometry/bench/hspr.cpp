// HSPR of a pair of lamps: rows, points, scores, classes.
// Computes: the method as the program HSPR 2.1.1 does it (rounding half to even, at its places), and beside each figure
// the physical one. Source: the project's notes on that program, which says that it computes GTB CE-5815; worked
// figures of the notes are the test. Frame: x right, y up, z ahead. Leaves out: left-hand traffic (the method has
// none). Checked by tests/photometry/hspr_test.cpp.
#include "visual/photometry/bench/hspr.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/trigonometric.hpp>

#include "visual/photometry/beam/beam_image.h"
#include "visual/photometry/bench/cutoff.h"

namespace phare {
namespace {

constexpr double kFar_m = 400.0, kRangeStep_m = 0.5;
constexpr double kHighFar_m = 800.0;
constexpr double kWide_m = 20.0, kWidthStep_m = 0.1;
constexpr double kThresholds_lx[] = {1.0, 3.0, 5.0};

constexpr const char* kNearestNode =
    "the method takes the grid's nearest node in place of what lies between, and its walk's last step of 0.5 m "
    "(ranges) or "
    "0.1 m (widths)";
constexpr const char* kEdge =
    "the method goes on with the edge of its grid beyond 45 deg; physically the table goes on, or is dark";
constexpr const char* kFluxDeparture =
    "the method leaves out the cosine of V and turns each lamp's grid outwards a little";
constexpr const char* kGlareDeparture = "the method leaves out the cosine at the window";

/// To so many decimals, half to even as the decimal number stands.
double rounded(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return std::strtod(text, nullptr) + 0.0;  // no -0
}

using Walk = std::optional<double>;

/// The mean of what the walks reached, thresholds outside, places inside. The method leaves out one that never is
/// reached and all after it; physically it reaches 0 m.
std::optional<double> mean_range(HsprView view, const std::vector<Walk>& walks) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const Walk& walk : walks) {
    if (!walk && view == HsprView::kMethod) break;
    sum += walk.value_or(0.0);
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / static_cast<double>(count);
}

/// Straight ahead from each x: z. Along `right_deg` to the right from each x: z of the way there.
std::optional<double> range(const HsprLight& light, HsprView view, const std::vector<double>& x_m, double y_m,
                            double right_deg = 0.0) {
  const double sine = std::sin(glm::radians(right_deg)), cosine = std::cos(glm::radians(right_deg));
  std::vector<Walk> walks;
  for (const double threshold : kThresholds_lx) {
    for (const double x : x_m) {
      walks.push_back(hspr_reach(view, kFar_m, kRangeStep_m, threshold,
                                 [&](double s) { return light.lux(view, x + s * sine, y_m, s * cosine); }));
      if (walks.back()) *walks.back() *= cosine;
    }
  }
  return mean_range(view, walks);
}

/// How far 3 lx reaches to one side (-1 left, +1 right), mean over distances. Never: 0 (the program hangs there).
double width(const HsprLight& light, HsprView view, const std::vector<double>& z_m, double y_m, double side) {
  double sum = 0.0;
  for (const double z : z_m)
    sum += hspr_reach(view, kWide_m, kWidthStep_m, 3.0, [&](double x) {
             return light.lux(view, side * x, y_m, z);
           }).value_or(0.0);
  return sum / static_cast<double>(z_m.size());
}

double sum_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum;
}

/// Weights of the low beam's window: cells of 10 rows and 115 columns of samples.
double low_weight(int row, int column) {
  static constexpr double kCells[5][8] = {{.2, .2, .2, .2, .2, .2, .2, .2},
                                          {.2, .2, .5, .5, .5, .5, .5, .2},
                                          {.2, .2, .5, 1., 1., 1., .5, .2},
                                          {.2, .2, .5, 1., 1., 1., .5, .2},
                                          {.2, .2, .5, .5, .5, .5, .5, .2}};
  return kCells[row / 10][column / 115];
}
double adb_weight(int row, int) {
  static constexpr double kRows[5] = {.2, .5, 1., 1., .5};
  return kRows[row / 10];
}

struct Scale {
  const char* id;
  const char* what;
  const char* unit;
  double one, two, weight;
};

/// Both views of one row; the method's rounded as it rounds (negative: not at all).
template <typename Ask>
void add_row(HsprResult& result, const Scale& scale, int decimals, const char* departure, const Ask& ask) {
  HsprRow row{.id = scale.id, .what = scale.what, .unit = scale.unit};
  row.value = ask(HsprView::kMethod);
  if (row.value && decimals >= 0) row.value = rounded(*row.value, decimals);
  row.physical = ask(HsprView::kPhysical);
  row.one_point = scale.one;
  row.two_points = scale.two;
  row.weight = scale.weight;
  row.departure = departure;
  result.rows.push_back(std::move(row));
}

void conclude(HsprResult& result) {
  double weighted = 0.0, physical = 0.0;
  bool all = true, all_physical = true;
  for (HsprRow& row : result.rows) {
    const auto points = [&](double value) { return (value - row.one_point) / (row.two_points - row.one_point) + 1.0; };
    if (row.value) row.points = rounded(points(*row.value), 3);
    if (row.physical) row.physical_points = points(*row.physical);
    all = all && row.points.has_value();
    all_physical = all_physical && row.physical_points.has_value();
    weighted += row.weight * row.points.value_or(0.0);
    physical += row.weight * row.physical_points.value_or(0.0);
  }
  const auto score = [&](double sum) { return 4.0 * (sum - result.worst) / (result.best - result.worst) + 1.0; };
  if (all) result.weighted = weighted, result.score = rounded(score(weighted), 2);
  if (all_physical) result.physical_weighted = physical, result.physical_score = score(physical);
}

}  // namespace

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
  const HsprLight light(lamps);
  HsprResult result{.worst = 11.15, .best = 17.61};
  add_row(result, {"A", "range ahead, 1, 3, 5 lx at x 0, 1.5, 3 m", "m", 71.6, 95.1, 1.5}, 3, kNearestNode,
          [&](HsprView view) {
            return range(light, view, {0.0, 1.5, 3.0}, 0.0);
          });
  add_row(result, {"B", "range along 5 deg right from x 0, 1.5, 3 m", "m", 71.5, 138.4, 1.0}, 3, kNearestNode,
          [&](HsprView view) {
            return range(light, view, {0.0, 1.5, 3.0}, 0.0, 5.0);
          });
  add_row(result, {"C", "range on the oncoming side, x -3, -4.5, -6 m, 0.25 m high", "m", 32.7, 48.4, 1.0}, 3,
          kNearestNode, [&](HsprView view) {
            return range(light, view, {-3.0, -4.5, -6.0}, 0.25);
          });
  const std::vector<double> far{30.0, 40.0, 50.0}, near{10.0, 20.0};
  const auto side = [&](const std::vector<double>& z, double y, double to) {
    return [&light, z, y, to](HsprView view) { return std::optional(width(light, view, z, y, to)); };
  };
  add_row(result, {"D off", "3 lx width at 30, 40, 50 m, oncoming side", "m", 4.8, 12.5, 0.75}, 3, kNearestNode,
          side(far, 0.0, -1.0));
  add_row(result, {"D near", "3 lx width at 30, 40, 50 m, own side", "m", 7.6, 16.3, 0.75}, 3, kNearestNode,
          side(far, 0.0, 1.0));
  add_row(result, {"E off", "3 lx width at 10, 20 m, 0.25 m high, oncoming side", "m", 5.9, 9.6, 0.5}, 3, kEdge,
          side(near, 0.25, -1.0));
  add_row(result, {"E near", "3 lx width at 10, 20 m, 0.25 m high, own side", "m", 6.6, 10.5, 0.5}, 3, kEdge,
          side(near, 0.25, 1.0));
  add_row(result, {"flux", "flux in +-45 deg x -15 to +5 deg", "lm", 747.6, 1785.1, 1.0}, 3, kFluxDeparture,
          [&](HsprView view) { return std::optional(light.flux_lm(view, -15.0, 5.0, 1000.0)); });
  const HsprStrip window{.x_m = -7.9, .columns = 920};
  add_row(result, {"glare", "weighted flux to oncoming eyes at 50 m", "lm", 0.73, 0.27, 1.0}, -1, kGlareDeparture,
          [&](HsprView view) {
            return std::optional(sum_of(light.glare_lm(view, {&window, 1}, low_weight)));
          });
  conclude(result);
  return result;
}

HsprResult hspr_high_beam(const std::vector<HsprLamp>& lamps) {
  const HsprLight light(lamps);
  double height = 0.0;
  for (const HsprLamp& lamp : lamps) height += lamp.y_m / static_cast<double>(lamps.size());
  HsprResult result{.worst = 11.31, .best = 19.23};
  const struct {
    Scale scale;
    double x_m, y_m;
  } rays[] = {{{"A", "3 lx on the ray through (0, h) at 100 m", "m", 133.3, 235.0, 2.0}, 0.0, height},
              {{"B", "3 lx on the ray through (-20, h) at 100 m", "m", 29.1, 61.0, 0.8}, -20.0, height},
              {{"C", "3 lx on the ray through (0, h + 9) at 100 m", "m", 31.5, 63.3, 0.4}, 0.0, height + 9.0},
              {{"D", "3 lx on the ray through (20, h) at 100 m", "m", 41.9, 81.4, 0.8}, 20.0, height},
              {{"E", "3 lx on the ray through (0, h - 2) at 100 m", "m", 134.2, 207.7, 1.0}, 0.0, height - 2.0}};
  for (const auto& ray : rays) {
    const double length = std::sqrt(ray.x_m * ray.x_m + ray.y_m * ray.y_m + 1e4);
    const bool below = ray.y_m < 0.0;
    add_row(result, ray.scale, -1,
            below ? "the method's ray starts on the road and runs below it, where no light comes" : kNearestNode,
            [&](HsprView view) -> std::optional<double> {
              if (below && view == HsprView::kPhysical) return std::nullopt;
              return hspr_reach(view, kHighFar_m, kRangeStep_m, 3.0, [&](double s) {
                return light.lux(view, s * ray.x_m / length, s * ray.y_m / length, s * 100.0 / length);
              });
            });
  }
  const std::vector<double> near{10.0, 20.0};
  add_row(result, {"E off", "3 lx width at 10, 20 m, 0.25 m high, left", "m", 5.5, 10.5, 1.0}, 3, kEdge,
          [&](HsprView view) { return std::optional(width(light, view, near, 0.25, -1.0)); });
  add_row(result, {"E near", "3 lx width at 10, 20 m, 0.25 m high, right", "m", 5.9, 10.9, 1.0}, 3, kEdge,
          [&](HsprView view) { return std::optional(width(light, view, near, 0.25, 1.0)); });
  add_row(result, {"flux", "flux in +-45 deg x -5 to +10 deg", "lm", 1114.1, 3126.1, 1.0}, 3, kFluxDeparture,
          [&](HsprView view) { return std::optional(light.flux_lm(view, -5.0, 10.0, 1000.0)); });
  conclude(result);
  return result;
}

namespace {

/// One- and two-point values of A', B, C', flux and glare, oncoming and preceding, at 50, 100, 200 m.
struct AdbScale {
  double ahead[2], right[2], left[2], flux[2];
};
constexpr AdbScale kAdbScales[2][3] = {{{{113.0, 228.2}, {119.9, 182.0}, {27.3, 86.3}, {1889.3, 2829.9}},
                                        {{92.8, 209.9}, {127.1, 182.9}, {65.0, 86.9}, {1949.7, 2962.7}},
                                        {{81.3, 176.0}, {130.6, 183.2}, {89.4, 131.1}, {1993.6, 3038.5}}},
                                       {{{39.8, 57.0}, {124.1, 181.4}, {74.6, 117.5}, {1843.7, 2748.6}},
                                        {{52.9, 82.7}, {134.8, 184.0}, {94.7, 150.0}, {1943.9, 2898.7}},
                                        {{66.2, 113.2}, {132.9, 183.3}, {110.9, 177.4}, {2025.2, 2979.9}}}};
constexpr double kAdbGlare[2][2] = {{0.28, 0.11}, {0.35, 0.16}};
constexpr double kAdbDistances_m[3] = {50.0, 100.0, 200.0};

void add_block_out(const HsprLight& light, bool preceding, double distance_m, std::vector<HsprBlockOut>& rows) {
  const struct {
    bool preceding;
    double distance_m;
    const char* id;
    double from, to;
    bool from_stays, to_stays;
    double v, limit_cd;
  } table[] = {{true, 50, "prec. 50 a", -2.2, 1.0, false, true, 0.30, 2475},
               {true, 50, "prec. 50 b", 1.0, 2.2, true, false, 0.30, 4250},
               {false, 50, "onc. 50", -5.3, -1.5, false, false, 0.57, 975},
               {true, 100, "prec. 100 a", -1.4, 0.5, false, true, 0.15, 5300},
               {true, 100, "prec. 100 b", 0.5, 1.4, true, false, 0.15, 8750},
               {false, 100, "onc. 100", -2.9, -0.5, false, false, 0.30, 1750},
               {true, 200, "prec. 200", -0.95, 0.95, false, false, 0.10, 16000},
               {false, 200, "onc. 200", -1.7, 0.0, false, false, 0.15, 5450}};
  const double shift_deg = glm::degrees(std::asin(0.5 * light.spacing_m() / distance_m));
  for (const auto& row : table) {
    if (row.preceding != preceding || row.distance_m != distance_m) continue;
    for (std::size_t k = 0; k < light.lamps().size(); ++k) {
      const double shift = light.lamps()[k].x_m < 0.0 ? shift_deg : -shift_deg;
      const double from = row.from + (row.from_stays ? 0.0 : shift), to = row.to + (row.to_stays ? 0.0 : shift);
      rows.push_back(
          {row.id, k == 0 ? "left" : "right", from, to, row.v, light.brightest_cd(k, from, to, row.v), row.limit_cd});
    }
  }
}

}  // namespace

HsprAdb hspr_adb(const std::array<std::vector<HsprLamp>, 6>& situations) {
  HsprAdb adb;
  for (std::size_t d = 0; d < 3; ++d) adb.distances[d] = {.worst = 9.35, .best = 20.81};
  for (std::size_t kind = 0; kind < 2; ++kind) {  // oncoming, preceding
    const std::string name = kind == 0 ? "onc. " : "prec. ";
    std::optional<double> glare, physical_glare;
    for (std::size_t d = 0; d < 3; ++d) {
      HsprResult& result = adb.distances[d];
      const HsprLight light(situations[3 * kind + d]);
      const AdbScale& scale = kAdbScales[kind][d];
      const std::string ids[5] = {name + "A'", name + "B", name + "C'", name + "flux", name + "glare"};
      add_row(result,
              {ids[0].c_str(), "range ahead, 1, 3, 5 lx at x 1.5, 3 m, 1.5 m high", "m", scale.ahead[0], scale.ahead[1],
               1.5},
              3, kNearestNode, [&](HsprView view) {
                return range(light, view, {1.5, 3.0}, 1.5);
              });
      add_row(result,
              {ids[1].c_str(), "range along 5 deg right from x 0, 1.5, 3 m, 1.5 m high", "m", scale.right[0],
               scale.right[1], 1.0},
              3, kNearestNode, [&](HsprView view) {
                return range(light, view, {0.0, 1.5, 3.0}, 1.5, 5.0);
              });
      add_row(result, {ids[2].c_str(), "range at x -4.5, -6 m, 1.5 m high", "m", scale.left[0], scale.left[1], 1.0}, 3,
              kNearestNode, [&](HsprView view) {
                return range(light, view, {-4.5, -6.0}, 1.5);
              });
      add_row(result, {ids[3].c_str(), "flux in +-45 deg x -5 to +10 deg", "lm", scale.flux[0], scale.flux[1], 0.5}, 3,
              kFluxDeparture,
              [&](HsprView view) { return std::optional(light.flux_lm(view, -5.0, 10.0, kAdbDistances_m[d])); });
      add_row(result,
              {ids[4].c_str(), "weighted flux to the other's eyes, from the lamps of 50 m", "lm", kAdbGlare[kind][0],
               kAdbGlare[kind][1], 0.5},
              -1, kind == 0 ? kGlareDeparture : "the method leaves out the cosine and moves the second strip by 0.03 m",
              [&](HsprView view) {
                std::optional<double>& kept = view == HsprView::kMethod ? glare : physical_glare;
                if (kept) return kept;  // of 50 m, for all three
                const std::vector<HsprStrip> strips =
                    kind == 0 ? std::vector<HsprStrip>{{.x_m = -4.2, .columns = 245}}
                              : std::vector<HsprStrip>{{.x_m = -1.48, .columns = 235},
                                                       {.x_m = 0.87, .columns = 61, .factor = 0.74, .z_end_m = 50.03}};
                std::vector<double> lamps = light.glare_lm(view, strips, adb_weight);
                if (view == HsprView::kMethod)
                  for (double& lm : lamps) lm = rounded(lm, 3);
                kept = sum_of(lamps);
                return kept;
              });
      add_block_out(light, kind == 1, kAdbDistances_m[d], adb.block_out);
    }
  }
  double sum = 0.0;
  bool all = true;
  for (HsprResult& result : adb.distances) {
    conclude(result);
    all = all && result.score.has_value();
    sum += result.score.value_or(0.0);
  }
  if (all) adb.score = rounded(sum / 3.0, 2);
  return adb;
}

std::string hspr_class(double score) {
  return score < 10.0   ? "Standard"
         : score < 19.5 ? "Good"
         : score < 29.5 ? "Advanced"
         : score < 39.5 ? "Excellent"
         : score < 49.5 ? "Premium"
                        : "Premium+";
}

std::vector<HsprSystem> hspr_systems(double low, double high, std::optional<double> adb) {
  const double low_ep = rounded(5.8 * low + 64.17, 2), high_ep = rounded(11.71 * high + 141.27, 2);
  std::vector<HsprSystem> systems{{"manual", 0.95 * low_ep + 0.05 * high_ep},
                                  {"automatic", 0.8 * low_ep + 0.2 * high_ep}};
  if (adb) {
    const double adb_ep = rounded(10.87 * *adb + 94.13, 2);
    systems.push_back({"ADB", 0.3 * low_ep + 0.2 * high_ep + 0.5 * adb_ep});
  }
  for (HsprSystem& system : systems) {
    system.score = rounded(0.626 * system.mean_performance - 36.42, 1);
    system.grade = hspr_class(system.score);
  }
  return systems;
}

}  // namespace phare
