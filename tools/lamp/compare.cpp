// phare lamp compare: two beams, aligned by their cut-offs first, then difference and ratio in angle space and on the
// road.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>
#include <optional>

#include "tools/commands.h"
#include "tools/lamp/lamp_commands.h"
#include "tools/lamp/print_json.h"
#include "tools/lamp/views.h"
#include "visual/photometry/beam/beam_image.h"
#include "visual/photometry/bench/cutoff_line.h"

namespace phare {
namespace {

struct Difference {
  double worst_cd = 0.0, worst_h_deg = 0.0, worst_v_deg = 0.0;
  double mean_abs_cd = 0.0, correlation = 0.0;
  double compared_01 = 0.0;  ///< share of the field in which both files have data; only there it is looked at
};

bool has_data(const IntensityHv& intensity, double h_deg, double v_deg) {
  return !intensity.evidence || intensity.evidence(h_deg, v_deg) != Evidence::kNone;
}

/// Over H ±20°, V -10 to +5° in 0.1°.
Difference differ(const IntensityHv& a, const IntensityHv& b) {
  Difference d;
  double sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0, n = 0, all = 0;
  for (double v = -10.0; v <= 5.001; v += 0.1) {
    for (double h = -20.0; h <= 20.001; h += 0.1) {
      all += 1;
      if (!has_data(a, h, v) || !has_data(b, h, v)) continue;
      const double x = a(h, v), y = b(h, v), difference = std::abs(y - x);
      if (difference > d.worst_cd) d.worst_cd = difference, d.worst_h_deg = h, d.worst_v_deg = v;
      d.mean_abs_cd += difference;
      sa += x, sb += y, saa += x * x, sbb += y * y, sab += x * y, n += 1;
    }
  }
  d.compared_01 = n / all;
  n = std::max(n, 1.0);
  d.mean_abs_cd /= n;
  const double spread = (saa - sa * sa / n) * (sbb - sb * sb / n);
  const double same = d.mean_abs_cd == 0.0 ? 1.0 : 0.0;  // one of them is even: it tells nothing of the other
  d.correlation = spread > 0.0 ? (sab - sa * sb / n) / std::sqrt(spread) : same;
  return d;
}

struct Place {
  const char* name;
  double h_deg, v_deg;
};
constexpr Place kPlaces[] = {{"HV", 0, 0},          {"B50L", -3.43, 0.57}, {"BR", 2.5, 1.0},     {"75R", 1.15, -0.57},
                             {"50L", -3.43, -0.86}, {"50V", 0, -0.86},     {"50R", 1.72, -0.86}, {"25L", -9, -1.72},
                             {"25R", 9, -1.72},     {"H-3L", -3, 0},       {"H-3R", 3, 0}};
struct RoadPlace {
  const char* name;
  double x_m, y_m;
};
// Edges are the lines of `plot`: lanes of 3.5 m, the lamp over the middle of its own.
constexpr RoadPlace kRoad[] = {{"own lane, 25 m", 25, 0},       {"own lane, 50 m", 50, 0},
                               {"own lane, 75 m", 75, 0},       {"own lane, 100 m", 100, 0},
                               {"right edge, 50 m", 50, -1.75}, {"left lane, 50 m", 50, 3.5},
                               {"left edge, 25 m", 25, 5.25}};

/// A lamp with what its cut-off looks like.
struct Lamp {
  IntensityTable table;
  CutoffShape shape;
  explicit Lamp(IntensityTable t)
      : table(std::move(t)), shape(cutoff_shape(mounted_intensity(table, glm::dmat3{1.0}))) {}
};

/// B beside A, turned as asked, over the wall.
struct Laid {
  CutoffAlignment turn;
  double pitch_a_deg = 0.0, pitch_b_deg = 0.0, yaw_b_deg = 0.0;
  IntensityHv in_a, in_b;
  Difference difference;
};

/// B is turned onto A; A itself is put on 0.57° down where it has a cut-off, so that places mean what they say.
Laid lay(const Lamp& a, const Lamp& b, bool align) {
  Laid laid;
  if (align) laid.turn = align_cutoffs(a.table, b.table, a.shape, b.shape);
  laid.pitch_a_deg = a.shape.side != CutoffSide::kNone ? -0.57 - a.shape.flat_v_deg : 0.0;
  laid.pitch_b_deg = laid.pitch_a_deg + laid.turn.up_deg;
  laid.yaw_b_deg = -laid.turn.right_deg;
  laid.in_a = mounted_intensity(a.table, aim_rotation(0.0, glm::radians(laid.pitch_a_deg), 0.0));
  laid.in_b =
      mounted_intensity(b.table, aim_rotation(glm::radians(laid.yaw_b_deg), glm::radians(laid.pitch_b_deg), 0.0));
  laid.difference = differ(laid.in_a, laid.in_b);
  return laid;
}

std::string alignment_text(const Lamp& a, const Lamp& b, const Laid& laid, bool asked) {
  if (!asked) return "not aligned, as asked";
  if (!laid.turn.aligned) {
    const bool no_a = a.shape.side == CutoffSide::kNone, no_b = b.shape.side == CutoffSide::kNone;
    return std::string("not aligned, compared as filed: ") + (no_a && no_b ? "neither beam has a cut-off"
                                                              : no_a       ? "A has no cut-off"
                                                                           : "B has no cut-off");
  }
  char text[200];
  std::snprintf(text, sizeof text, "aligned by cut-off: B turned %+.3f deg up, %+.3f deg right", laid.turn.up_deg,
                laid.turn.right_deg);
  std::string why;
  if (laid.turn.up_open_deg > 0.06) {  // rows wider than the rules scan in
    char rows[80];
    std::snprintf(rows, sizeof rows, " (rows %.2g deg apart)", laid.turn.up_open_deg);
    why = rows;
  }
  if (laid.turn.other_side) {
    why += "; kinks laid together, but the cut-offs rise on opposite sides";
  } else if (!laid.turn.right_known) {
    why += "; not to the side, because a cut-off without a kink does not say where";
  }
  return text + why;
}

/// Turned round B fits A far better: a lamp for the other side of the road, or one file is mirrored.
bool looks_mirrored(const Difference& as_is, const Difference& turned) {
  return turned.correlation > 0.95 && turned.mean_abs_cd < 0.5 * as_is.mean_abs_cd;
}

/// Candela at a place, or none where the file has no data.
std::optional<double> at_place(const IntensityHv& intensity, const Place& place) {
  if (!has_data(intensity, place.h_deg, place.v_deg)) return std::nullopt;
  return intensity(place.h_deg, place.v_deg);
}

nlohmann::json ratio_of(double a, double b) {
  return a > 0.0 ? nlohmann::json(b / a) : nlohmann::json(nullptr);
}

std::string ratio_text(double a, double b) {
  char text[32] = "-";
  if (a > 0.0) std::snprintf(text, sizeof text, "%.3f", b / a);
  return text;
}

}  // namespace

int lamp_compare(const LampCompareOptions& options) {
  auto table_a = read_lamp(options.a, options.settings);
  if (!table_a) return bad_input(table_a.error());
  auto table_b = read_lamp(options.b, options.settings);
  if (!table_b) return bad_input(table_b.error());
  if (options.mirror_b) mirror_left_right(*table_b);
  const Lamp a(std::move(*table_a)), b(std::move(*table_b));
  const Laid laid = lay(a, b, options.align);
  const Difference& d = laid.difference;
  const IntensityHv &in_a = laid.in_a, &in_b = laid.in_b;
  const double flux_a_lm = a.table.flux_lm(), flux_b_lm = b.table.flux_lm();
  const auto pair = [&](const Lamp& lamp, double pitch_deg, double yaw_deg) {
    return std::vector<RoadLamp>{{&lamp.table, 0.6, options.height_m, pitch_deg, yaw_deg},
                                 {&lamp.table, -0.6, options.height_m, pitch_deg, yaw_deg}};
  };
  const std::vector<RoadLamp> road_a = pair(a, laid.pitch_a_deg, 0.0);
  const std::vector<RoadLamp> road_b = pair(b, laid.pitch_b_deg, laid.yaw_b_deg);

  const std::string alignment = alignment_text(a, b, laid, options.align);
  // Places and lanes lie as the side of traffic has them: A's, else B's, else it is assumed.
  const CutoffShape& telling = a.shape.tells_side() || !b.shape.tells_side() ? a.shape : b.shape;
  const bool left_hand = telling.side == CutoffSide::kRisesLeft;
  const double side = left_hand ? -1.0 : 1.0;
  const std::string traffic =
      std::string(left_hand ? "left" : "right") + "-hand traffic (" + side_source(telling) + ")";
  IntensityTable turned_b = b.table;
  mirror_left_right(turned_b);
  const Lamp mirrored_b(std::move(turned_b));
  const Difference mirrored = lay(a, mirrored_b, options.align).difference;
  const bool mirror = looks_mirrored(d, mirrored);

  std::vector<std::string> written;
  if (!options.out.empty()) {
    std::error_code code;
    std::filesystem::create_directories(options.out, code);
    const std::string names = a.table.name + " (A), " + b.table.name + " (B)";
    const auto draw = [&](Chart& c) { draw_ratio(c, in_a, in_b, names, alignment); };
    const auto draw_both = [&](Chart& c) {
      draw_difference(c, in_a, in_b, road_a, road_b, names + ": difference", alignment);
    };
    for (const auto& [stem, view] :
         {std::pair<const char*, std::function<void(Chart&)>>{"/ratio", draw}, {"/difference", draw_both}}) {
      if (const Status status = write_chart(options.out + stem, kPageWidth, kPageHeight, view); !status)
        return bad_input(status.error());
      for (const char* ending : {".svg", ".png"}) written.push_back(options.out + stem + ending);
    }
  }
  if (options.json) {
    nlohmann::json json{{"a", options.a},
                        {"b", options.b},
                        {"alignment", alignment},
                        {"traffic", left_hand ? "left" : "right"},
                        {"traffic_source", telling.tells_side() ? "by the cut-off" : "assumed"},
                        {"cutoff_forms", {form_name(a.shape.form), form_name(b.shape.form)}},
                        {"aligned_by_cutoff", laid.turn.aligned},
                        {"b_turned_up_deg", laid.turn.up_deg},
                        {"b_turned_right_deg", laid.turn.right_deg},
                        {"right_known", laid.turn.right_known},
                        {"cutoffs_apart_deg", laid.turn.apart_deg},
                        {"left_open_by_rows_deg", {{"up", laid.turn.up_open_deg}, {"right", laid.turn.right_open_deg}}},
                        {"worst_difference_cd", d.worst_cd},
                        {"worst_at_deg", {d.worst_h_deg, d.worst_v_deg}},
                        {"mean_absolute_difference_cd", d.mean_abs_cd},
                        {"correlation", d.correlation},
                        {"compared_share_of_field", d.compared_01},
                        {"mirrored",
                         {{"likely", mirror},
                          {"correlation", mirrored.correlation},
                          {"worst_difference_cd", mirrored.worst_cd},
                          {"mean_absolute_difference_cd", mirrored.mean_abs_cd}}},
                        {"flux_a_lm", flux_a_lm},
                        {"flux_b_lm", flux_b_lm},
                        {"peak_a_cd", a.table.peak_cd()},
                        {"peak_b_cd", b.table.peak_cd()},
                        {"files", written}};
    for (const Place& printed : kPlaces) {
      const Place p{printed.name, side * printed.h_deg, printed.v_deg};
      const auto x = at_place(in_a, p), y = at_place(in_b, p);
      nlohmann::json one{{"name", p.name}, {"h_deg", p.h_deg}, {"v_deg", p.v_deg}};
      one["a_cd"] = x ? nlohmann::json(*x) : nlohmann::json(nullptr);
      one["b_cd"] = y ? nlohmann::json(*y) : nlohmann::json(nullptr);
      one["difference_cd"] = x && y ? nlohmann::json(*y - *x) : nlohmann::json(nullptr);
      one["ratio"] = x && y ? ratio_of(*x, *y) : nlohmann::json(nullptr);
      json["points"].push_back(std::move(one));
    }
    for (const RoadPlace& printed : kRoad) {
      const RoadPlace p{printed.name, printed.x_m, side * printed.y_m};
      const double x = road_lux(road_a, p.x_m, p.y_m, 0.25, true), y = road_lux(road_b, p.x_m, p.y_m, 0.25, true);
      json["road"].push_back({{"name", p.name},
                              {"x_m", p.x_m},
                              {"y_m", p.y_m},
                              {"a_lx", x},
                              {"b_lx", y},
                              {"difference_lx", y - x},
                              {"ratio", ratio_of(x, y)}});
    }
    print_json(json);
    return kExitDone;
  }
  std::printf("A  %s: %.0f cd, %.0f lm\nB  %s: %.0f cd, %.0f lm\n", base_name(options.a).c_str(), a.table.peak_cd(),
              flux_a_lm, base_name(options.b).c_str(), b.table.peak_cd(), flux_b_lm);
  std::printf("%s\n", alignment.c_str());
  if (laid.turn.aligned && !laid.turn.other_side)
    std::printf("the two cut-offs are then %.3f deg apart on average\n", laid.turn.apart_deg);
  std::printf("worst difference %.0f cd at H %+.1f, V %+.1f; mean |difference| %.1f cd; correlation %.5f\n", d.worst_cd,
              d.worst_h_deg, d.worst_v_deg, d.mean_abs_cd, d.correlation);
  if (d.compared_01 < 0.9995)
    std::printf("of H +-20, V -10 to +5 deg %.0f %% compared: a file has no data in the rest\n", 100.0 * d.compared_01);
  if (mirror) {
    std::printf("B turned left to right fits A better: worst %.0f cd, correlation %.5f (--mirror-b compares so)\n",
                mirrored.worst_cd, mirrored.correlation);
  }
  std::printf("places for %s%s\n", traffic.c_str(),
              left_hand ? "; named as for right-hand traffic, and looked at on the other side" : "");
  std::printf("  %-18s %10s %10s %10s %8s\n", "cut-off at 0.57 D", "A cd", "B cd", "B - A", "B / A");
  for (const Place& printed : kPlaces) {
    const Place p{printed.name, side * printed.h_deg, printed.v_deg};
    const auto x = at_place(in_a, p), y = at_place(in_b, p);
    if (x && y) {
      std::printf("  %-18s %10.0f %10.0f %+10.0f %8s\n", p.name, *x, *y, *y - *x, ratio_text(*x, *y).c_str());
    } else {
      std::printf("  %-18s no data in %s\n", p.name, x ? "B" : y ? "A" : "both");
    }
  }
  std::printf("  %-18s %10s %10s %10s %8s\n", "pair, 0.25 m high", "A lx", "B lx", "B - A", "B / A");
  for (const RoadPlace& printed : kRoad) {
    const RoadPlace p{printed.name, printed.x_m, side * printed.y_m};
    const double x = road_lux(road_a, p.x_m, p.y_m, 0.25, true), y = road_lux(road_b, p.x_m, p.y_m, 0.25, true);
    std::printf("  %-18s %10.2f %10.2f %+10.2f %8s\n", p.name, x, y, y - x, ratio_text(x, y).c_str());
  }
  for (const std::string& file : written) std::printf("%s\n", file.c_str());
  return kExitDone;
}

}  // namespace phare
