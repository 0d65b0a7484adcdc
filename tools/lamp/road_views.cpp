// Views of the road from above. Computes: on the road E = I·h/r³, facing the car E = I·x/r³, summed over the lamps.
// Leaves out: everything but the direct light of the lamps.
#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <limits>

#include "config/isolux.h"
#include "tools/lamp/views.h"
#include "visual/photometry/beam/beam_image.h"

namespace phare {
namespace {

constexpr double kFacingHeight_m = 0.25;
constexpr Rgb kText{0.3, 0.3, 0.3};

/// road_lux with the aims worked out once.
std::function<double(double, double)> road_light(const std::vector<RoadLamp>& lamps, bool facing) {
  struct Mounted {
    RoadLamp lamp;
    glm::dmat3 car_from_lamp;
  };
  std::vector<Mounted> mounted;
  for (const RoadLamp& lamp : lamps)
    mounted.push_back({lamp, aim_rotation(glm::radians(lamp.yaw_deg), glm::radians(lamp.pitch_deg), 0.0)});
  const double z_m = facing ? kFacingHeight_m : 0.0;
  return [mounted, facing, z_m](double x_m, double y_m) {
    double lux = 0.0;
    for (const Mounted& m : mounted) {
      const glm::dvec3 d{x_m, y_m - m.lamp.y_m, z_m - m.lamp.z_m};
      const double r2 = d.x * d.x + d.y * d.y + d.z * d.z;
      const double cosine_r = facing ? d.x : -d.z;
      if (cosine_r <= 0.0) continue;
      lux += m.lamp.table->intensity_cd(d * m.car_from_lamp) * cosine_r / (r2 * std::sqrt(r2));
    }
    return lux;
  };
}

double signed_log(double value) {
  return std::copysign(std::log10(1.0 + std::abs(value)), value);
}

std::string signed_number(double value) {
  return (value > 0.0 ? "+" : value < 0.0 ? "-" : "") + short_number(std::abs(value));
}

/// One panel of differences: signed and logarithmic beyond one unit, so that what is small stays white and what is
/// large does not drown the rest.
struct DifferencePanel {
  Axes axes;
  double unit = 1.0, full = 1.0;  ///< one unit; where the colour is full, in units of what is shown
  std::vector<double> levels;
  std::string unit_name;
};

void draw_panel(Chart& chart, const DifferencePanel& panel, const Grid& grid) {
  const double full_log = signed_log(panel.full / panel.unit);
  const auto colour = [&](double log) { return difference_colour(log / full_log); };
  chart.picture(panel.axes, grid.x.size(), grid.y.size(),
                [&](std::size_t i, std::size_t j) { return colour(grid.at_pixel(i, j)); });
  chart.begin_clip(panel.axes);
  std::vector<PendingLabel> labels;
  std::vector<BarMark> marks{{0.0, "", "0"}};
  for (const double level : panel.levels) {
    for (const double sign : {-1.0, 1.0}) {
      const double log = signed_log(sign * level / panel.unit);
      draw_contours(chart, panel.axes, contours(grid.values, grid.x, grid.y, log), {0.25, 0.25, 0.25}, 0.7,
                    signed_number(sign * level), labels);
      marks.push_back({log, "", signed_number(sign * level)});
    }
  }
  draw_labels(chart, labels);
  chart.end_clip();
  const double left = panel.axes.left + panel.axes.width + 14;
  colour_bar(chart, left, panel.axes.top + 14, panel.axes.height - 14, -full_log, full_log, colour, marks);
  chart.text(left + 7, panel.axes.top, panel.unit_name, 9, 0, kBlack, true);
}

}  // namespace

double road_lux(const std::vector<RoadLamp>& lamps, double x_m, double y_m, double z_m, bool facing) {
  double lux = 0.0;
  for (const RoadLamp& lamp : lamps) {
    const glm::dvec3 d{x_m, y_m - lamp.y_m, z_m - lamp.z_m};
    const double r2 = d.x * d.x + d.y * d.y + d.z * d.z;
    const double cosine_r = facing ? d.x : -d.z;
    if (cosine_r <= 0.0) continue;
    const glm::dmat3 car_from_lamp = aim_rotation(glm::radians(lamp.yaw_deg), glm::radians(lamp.pitch_deg), 0.0);
    lux += lamp.table->intensity_cd(d * car_from_lamp) * cosine_r / (r2 * std::sqrt(r2));
  }
  return lux;
}

RoadExtent road_extent(const std::vector<RoadLamp>& lamps, bool facing) {
  constexpr double kFar_m = 400.0, kWide_m = 60.0, kStep_m = 2.0, kMargin_m = 4.0;
  const auto light = road_light(lamps, facing);
  double ahead = 0.0, aside = 0.0;
  for (double x = kStep_m; x <= kFar_m; x += kStep_m) {
    for (double y = -kWide_m; y <= kWide_m; y += kStep_m) {
      if (light(x, y) < 1.0) continue;
      ahead = x;
      aside = std::max(aside, std::abs(y));
    }
  }
  RoadExtent extent;
  extent.clipped = ahead + kStep_m > kFar_m || aside + kStep_m > kWide_m;
  const double step = ahead < 100.0 ? 10.0 : 20.0;
  extent.ahead_m = std::clamp(std::ceil((ahead + kMargin_m) / step) * step, 40.0, kFar_m);
  extent.aside_m = std::clamp(std::ceil((aside + kMargin_m) / 5.0) * 5.0, 15.0, kWide_m);
  return extent;
}

void draw_road(Chart& chart, const std::vector<RoadLamp>& lamps, bool left_hand, const std::string& title,
               const std::string& subtitle) {
  heading(chart, title, subtitle);
  constexpr double kLow = -1.0, kHigh = 2.2;  // 0.1 to 160 lx
  const auto colour = [](double log) { return chart_colour((log - kLow) / (kHigh - kLow)); };
  bool clipped = false;
  for (const int panel : {0, 1}) {
    const bool facing = panel == 1;
    const RoadExtent extent = road_extent(lamps, facing);
    clipped = clipped || extent.clipped;
    // y to the left is left on the page
    Axes axes{panel == 0 ? 62.0 : 440.0, 74, 320, 350, extent.aside_m, -extent.aside_m, 0, extent.ahead_m};
    const auto light = road_light(lamps, facing);
    const Grid grid = sample_grid([&](double y, double x) { return std::log10(std::max(light(x, y), 1e-4)); },
                                  axes.x_min, axes.x_max, 0.01, axes.y_max, 241, 321);
    chart.picture(axes, grid.x.size(), grid.y.size(),
                  [&](std::size_t i, std::size_t j) { return colour(grid.at_pixel(i, j)); });
    chart.begin_clip(axes);
    for (const double lane : lane_lines_m(left_hand))
      chart.line({{axes.x(lane), axes.top}, {axes.x(lane), axes.top + axes.height}}, {0.75, 0.75, 0.75}, 0.8, false,
                 true);
    std::vector<PendingLabel> labels;
    for (const double lx : kIsoluxLevels_lx) {
      const bool main = lx <= 5.0;
      draw_contours(chart, axes, contours(grid.values, grid.x, grid.y, std::log10(lx)),
                    main ? Rgb{0.4, 1.0, 0.55} : kWhite, main ? 1.4 : 0.8, short_number(lx) + " lx", labels);
    }
    for (const RoadLamp& lamp : lamps) chart.circle(axes.x(lamp.y_m), axes.y(0.0), 3, kWhite, 0.0, true);
    draw_labels(chart, labels);
    chart.end_clip();
    chart.axes(axes, extent.aside_m > 30.0 ? 10 : 5,
               extent.ahead_m > 200.0   ? 40
               : extent.ahead_m > 100.0 ? 20
                                        : 10,
               "y in m, left positive", "x ahead of the lamps in m", {0.5, 0.5, 0.5}, 0.2);
    chart.text(axes.left, 62, facing ? "E facing the car (vertical plane, 0.25 m high)" : "E on the road (horizontal)",
               10, -1, kBlack, true);
  }
  std::vector<BarMark> marks;
  std::string levels;
  for (const double lx : {0.1, 0.3}) marks.push_back({std::log10(lx), "", short_number(lx)});
  for (const double lx : kIsoluxLevels_lx) {
    marks.push_back({std::log10(lx), "", short_number(lx)});
    levels += (levels.empty() ? "" : ", ") + short_number(lx) + (lx == 5.0 ? " (green)" : "");
  }
  colour_bar(chart, 790, 88, 336, kLow, kHigh, colour, marks);
  chart.text(797, 76, "lx", 9, 0, kBlack, true);
  chart.text(430, 472,
             "isolux " + levels + " lx; dashed: two lanes of 3.5 m, the car in the middle of the " +
                 (left_hand ? "left" : "right") + " one" + (clipped ? "; 1 lx reaches beyond this page" : ""),
             8.5, 0, kText);
}

void draw_difference(Chart& chart, const IntensityHv& a, const IntensityHv& b, const std::vector<RoadLamp>& road_a,
                     const std::vector<RoadLamp>& road_b, const std::string& title, const std::string& subtitle) {
  heading(chart, title, subtitle);
  const DifferencePanel wall{{62, 74, 350, 350, -15, 15, -5, 4}, 100.0, 10000.0, {300, 1000, 3000, 10000}, "cd"};
  const Grid candela = sample_grid(
      [&](double h, double v) {
        const bool none =
            (a.evidence && a.evidence(h, v) == Evidence::kNone) || (b.evidence && b.evidence(h, v) == Evidence::kNone);
        return none ? std::numeric_limits<double>::quiet_NaN() : signed_log((b(h, v) - a(h, v)) / wall.unit);
      },
      wall.axes.x_min, wall.axes.x_max, wall.axes.y_min, wall.axes.y_max, 501, 301);
  draw_panel(chart, wall, candela);
  draw_no_data_note(chart, 66, 472, candela);
  chart.line({{wall.axes.x(0), wall.axes.top}, {wall.axes.x(0), wall.axes.top + wall.axes.height}}, kBlack, 1.1);
  chart.line({{wall.axes.left, wall.axes.y(0)}, {wall.axes.left + wall.axes.width, wall.axes.y(0)}}, kBlack, 1.1);
  chart.axes(wall.axes, 5, 1, "H in deg, right positive", "V in deg, up positive", {0.6, 0.6, 0.6}, 0.2);
  chart.text(wall.axes.left, 62, "B - A in cd", 10, -1, kBlack, true);
  const RoadExtent first = road_extent(road_a, true), second = road_extent(road_b, true);
  const double aside = std::max(first.aside_m, second.aside_m), ahead = std::max(first.ahead_m, second.ahead_m);
  const DifferencePanel road{{530, 74, 250, 350, aside, -aside, 0, ahead}, 1.0, 30.0, {1, 3, 10, 30}, "lx"};
  const auto light_a = road_light(road_a, true), light_b = road_light(road_b, true);
  const Grid lux = sample_grid([&](double y, double x) { return signed_log(light_b(x, y) - light_a(x, y)); },
                               road.axes.x_min, road.axes.x_max, 0.01, road.axes.y_max, 241, 301);
  draw_panel(chart, road, lux);
  chart.axes(road.axes, aside > 30.0 ? 20 : 10, ahead > 200.0 ? 40 : 20, "y in m, left positive",
             "x ahead of the lamps in m", {0.6, 0.6, 0.6}, 0.2);
  chart.text(road.axes.left, 62, "B - A in lx facing the car, pair, 0.25 m high", 10, -1, kBlack, true);
  chart.text(500, 472, "red: B gives more, blue: B gives less; signed logarithm of the difference", 8.5, 0, kText);
}

}  // namespace phare
