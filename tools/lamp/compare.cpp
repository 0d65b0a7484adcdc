// phare lamp compare: two beams, aligned by their cut-offs first, then difference and ratio in angle space and on the
// road.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include "tools/commands.h"
#include "tools/lamp/lamp_commands.h"
#include "tools/lamp/views.h"
#include "visual/photometry/beam_image.h"

namespace phare {
namespace {

struct Difference {
  double worst_cd = 0.0, worst_h_deg = 0.0, worst_v_deg = 0.0;
  double mean_abs_cd = 0.0, correlation = 0.0;
  double flux_a_lm = 0.0, flux_b_lm = 0.0;
};

/// Over H ±20°, V -10 to +5° in 0.1°.
Difference differ(const IntensityHv& a, const IntensityHv& b) {
  Difference d;
  double sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0, n = 0;
  for (double v = -10.0; v <= 5.001; v += 0.1) {
    for (double h = -20.0; h <= 20.001; h += 0.1) {
      const double x = a(h, v), y = b(h, v), difference = std::abs(y - x);
      if (difference > d.worst_cd) d.worst_cd = difference, d.worst_h_deg = h, d.worst_v_deg = v;
      d.mean_abs_cd += difference;
      sa += x, sb += y, saa += x * x, sbb += y * y, sab += x * y, n += 1;
    }
  }
  d.mean_abs_cd /= n;
  const double spread = (saa - sa * sa / n) * (sbb - sb * sb / n);
  d.correlation = spread > 0.0 ? (sab - sa * sb / n) / std::sqrt(spread) : 1.0;
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
constexpr RoadPlace kRoad[] = {{"own lane, 25 m", 25, 0},      {"own lane, 50 m", 50, 0},
                               {"own lane, 75 m", 75, 0},      {"own lane, 100 m", 100, 0},
                               {"right edge, 50 m", 50, -2.5}, {"left lane, 50 m", 50, 3.5},
                               {"left edge, 25 m", 25, 5.5}};

}  // namespace

int lamp_compare(const LampCompareOptions& options) {
  const auto a = read_lamp(options.a, options.settings);
  if (!a) return bad_input(a.error());
  const auto b = read_lamp(options.b, options.settings);
  if (!b) return bad_input(b.error());
  const CutoffShape shape_a = cutoff_shape(mounted_intensity(*a, glm::dmat3{1.0}));
  const CutoffShape shape_b = cutoff_shape(mounted_intensity(*b, glm::dmat3{1.0}));
  const auto kinked = [](const CutoffShape& s) {
    return s.side == CutoffSide::kRisesRight || s.side == CutoffSide::kRisesLeft;
  };
  const bool both = shape_a.side != CutoffSide::kNone && shape_b.side != CutoffSide::kNone && options.align;
  // B is turned onto A; A itself is put on 0.57° down where it has a cut-off, so that places mean what they say.
  const double pitch_a = shape_a.side != CutoffSide::kNone ? -0.57 - shape_a.flat_v_deg : 0.0;
  const double up = both ? shape_a.flat_v_deg - shape_b.flat_v_deg : 0.0;
  const double right = both && kinked(shape_a) && kinked(shape_b) ? shape_a.kink_h_deg - shape_b.kink_h_deg : 0.0;
  const double pitch_b = pitch_a + up;
  const IntensityHv in_a = mounted_intensity(*a, aim_rotation(0.0, glm::radians(pitch_a), 0.0));
  const IntensityHv in_b = mounted_intensity(*b, aim_rotation(-glm::radians(right), glm::radians(pitch_b), 0.0));
  Difference d = differ(in_a, in_b);
  d.flux_a_lm = a->flux_lm();
  d.flux_b_lm = b->flux_lm();
  const std::vector<RoadLamp> road_a{{&*a, 0.6, options.height_m, pitch_a}, {&*a, -0.6, options.height_m, pitch_a}};
  const std::vector<RoadLamp> road_b{{&*b, 0.6, options.height_m, pitch_b}, {&*b, -0.6, options.height_m, pitch_b}};

  std::string alignment = "not aligned: a beam has no cut-off, or --no-align";
  if (both) {
    char text[120];
    std::snprintf(text, sizeof text, "aligned by cut-off: B turned %+.3f deg up, %+.3f deg right", up, right);
    alignment = text;
  }
  if (options.json) {
    nlohmann::json json{{"a", options.a},
                        {"b", options.b},
                        {"aligned_by_cutoff", both},
                        {"b_turned_up_deg", up},
                        {"b_turned_right_deg", right},
                        {"worst_difference_cd", d.worst_cd},
                        {"worst_at_deg", {d.worst_h_deg, d.worst_v_deg}},
                        {"mean_absolute_difference_cd", d.mean_abs_cd},
                        {"correlation", d.correlation},
                        {"flux_a_lm", d.flux_a_lm},
                        {"flux_b_lm", d.flux_b_lm},
                        {"peak_a_cd", a->peak_cd()},
                        {"peak_b_cd", b->peak_cd()}};
    for (const Place& p : kPlaces) {
      const double x = in_a(p.h_deg, p.v_deg), y = in_b(p.h_deg, p.v_deg);
      json["points"].push_back({{"name", p.name},
                                {"h_deg", p.h_deg},
                                {"v_deg", p.v_deg},
                                {"a_cd", x},
                                {"b_cd", y},
                                {"difference_cd", y - x}});
    }
    for (const RoadPlace& p : kRoad) {
      const double x = road_lux(road_a, p.x_m, p.y_m, 0.25, true), y = road_lux(road_b, p.x_m, p.y_m, 0.25, true);
      json["road"].push_back({{"name", p.name}, {"a_lx", x}, {"b_lx", y}, {"difference_lx", y - x}});
    }
    std::printf("%s\n", json.dump(2).c_str());
  } else {
    std::printf("A  %s: %.0f cd, %.0f lm\nB  %s: %.0f cd, %.0f lm\n", base_name(options.a).c_str(), a->peak_cd(),
                d.flux_a_lm, base_name(options.b).c_str(), b->peak_cd(), d.flux_b_lm);
    std::printf("%s\n", alignment.c_str());
    std::printf("worst difference %.0f cd at H %+.1f, V %+.1f; mean |difference| %.1f cd; correlation %.5f\n",
                d.worst_cd, d.worst_h_deg, d.worst_v_deg, d.mean_abs_cd, d.correlation);
    std::printf("  %-18s %10s %10s %10s %8s\n", "cut-off at 0.57 D", "A cd", "B cd", "B - A", "B / A");
    for (const Place& p : kPlaces) {
      const double x = in_a(p.h_deg, p.v_deg), y = in_b(p.h_deg, p.v_deg);
      std::printf("  %-18s %10.0f %10.0f %+10.0f %8.3f\n", p.name, x, y, y - x, x > 0.0 ? y / x : 0.0);
    }
    std::printf("  %-18s %10s %10s %10s %8s\n", "pair, 0.25 m high", "A lx", "B lx", "B - A", "B / A");
    for (const RoadPlace& p : kRoad) {
      const double x = road_lux(road_a, p.x_m, p.y_m, 0.25, true), y = road_lux(road_b, p.x_m, p.y_m, 0.25, true);
      std::printf("  %-18s %10.2f %10.2f %+10.2f %8.3f\n", p.name, x, y, y - x, x > 0.0 ? y / x : 0.0);
    }
  }
  if (!options.out.empty()) {
    std::error_code code;
    std::filesystem::create_directories(options.out, code);
    const auto draw = [&](Chart& c) { draw_ratio(c, in_a, in_b, a->name + " (A), " + b->name + " (B)", alignment); };
    if (const Status written = write_chart(options.out + "/ratio", kPageWidth, kPageHeight, draw); !written)
      return bad_input(written.error());
    const auto draw_both = [&](Chart& c) {
      draw_difference(c, in_a, in_b, road_a, road_b, a->name + " (A), " + b->name + " (B): difference", alignment);
    };
    if (const Status written = write_chart(options.out + "/difference", kPageWidth, kPageHeight, draw_both); !written)
      return bad_input(written.error());
  }
  return kExitDone;
}

}  // namespace phare
