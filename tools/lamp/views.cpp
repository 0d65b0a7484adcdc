// Views of a beam: 25 m wall, road from above, vertical cut, false colour, ratio of two.
// Computes: I(H, V) of the lamp as mounted; E = I/625 lx at 25 m; on the road E = I·h/r³, facing the car E = I·x/r³.
// Leaves out: everything but the direct light of the lamps.
#include "tools/lamp/views.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/trigonometric.hpp>

#include "visual/photometry/beam_image.h"

namespace phare {
namespace {

std::string short_number(double value) {
  char text[32];
  if (value >= 10000.0) {
    std::snprintf(text, sizeof text, "%gk", value / 1000.0);
  } else {
    std::snprintf(text, sizeof text, "%g", value);
  }
  return text;
}

struct Grid {
  std::vector<double> x, y, values;  // values[y][x]
};

Grid sample(const std::function<double(double, double)>& f, double x_min, double x_max, double y_min, double y_max,
            std::size_t columns, std::size_t rows) {
  Grid grid;
  for (std::size_t i = 0; i < columns; ++i)
    grid.x.push_back(x_min + (x_max - x_min) * static_cast<double>(i) / static_cast<double>(columns - 1));
  for (std::size_t j = 0; j < rows; ++j)
    grid.y.push_back(y_min + (y_max - y_min) * static_cast<double>(j) / static_cast<double>(rows - 1));
  for (const double y : grid.y) {
    for (const double x : grid.x) grid.values.push_back(f(x, y));
  }
  return grid;
}

double log_cd(double cd) {
  return std::log10(std::max(cd, 1e-3));
}

void heading(Chart& chart, const std::string& title, const std::string& subtitle) {
  chart.text(62, 20, title, 13, -1, kBlack, true);
  chart.text(62, 38, subtitle, 9, -1, {0.3, 0.3, 0.3});
}

Rgb verdict_colour(Verdict verdict) {
  return verdict == Verdict::kPass ? kPass : verdict == Verdict::kFail ? kFailed : kWithin;
}

/// A row of the check where it is looked at: points as circles with their name, lines and areas as outlines.
void draw_rows(Chart& chart, const Axes& axes, const CheckResult& check) {
  const auto point = [&](HV p) { return std::array<double, 2>{axes.x(p.h_deg), axes.y(p.v_deg)}; };
  for (const CheckRow& row : check.rows) {
    if (row.at.empty()) continue;
    const Rgb colour = verdict_colour(row.verdict);
    std::vector<std::array<double, 2>> outline;
    for (const HV p : row.at) outline.push_back(point(p));
    if (row.shape == RowShape::kPolygon) {
      chart.line(outline, colour, 1.4, true);
    } else if (row.shape == RowShape::kArea) {
      const HV a = row.at[0], b = row.at[1];
      chart.line(
          {point({a.h_deg, a.v_deg}), point({b.h_deg, a.v_deg}), point({b.h_deg, b.v_deg}), point({a.h_deg, b.v_deg})},
          colour, 1.2, true, true);
    } else if (row.shape == RowShape::kLine) {
      chart.line(outline, colour, 1.6);
    }
  }
  for (const CheckRow& row : check.rows) {
    if (row.shape != RowShape::kPoints && row.shape != RowShape::kSum) continue;
    const Rgb colour = verdict_colour(row.verdict);
    for (const HV p : row.at) {
      const auto at = point(p);
      if (row.verdict == Verdict::kFail) {
        chart.line({{at[0] - 4, at[1] - 4}, {at[0] + 4, at[1] + 4}}, kWhite, 3.4);
        chart.line({{at[0] - 4, at[1] + 4}, {at[0] + 4, at[1] - 4}}, kWhite, 3.4);
        chart.line({{at[0] - 4, at[1] - 4}, {at[0] + 4, at[1] + 4}}, colour, 2.0);
        chart.line({{at[0] - 4, at[1] + 4}, {at[0] + 4, at[1] - 4}}, colour, 2.0);
      } else {
        chart.circle(at[0], at[1], 3.4, kWhite, 0.0, true);
        chart.circle(at[0], at[1], 2.6, colour, 0.0, true);
      }
    }
    if (row.shape == RowShape::kPoints && row.id.size() <= 6) {
      const auto at = point(row.at.front());
      chart.text(at[0] + 5, at[1] - 6, row.id, 7.5, -1, row.verdict == Verdict::kFail ? kFailed : kBlack, true, true);
    }
  }
}

void draw_cross(Chart& chart, const Axes& axes, Rgb colour) {
  chart.line({{axes.x(0), axes.top}, {axes.x(0), axes.top + axes.height}}, colour, 1.1);
  chart.line({{axes.left, axes.y(0)}, {axes.left + axes.width, axes.y(0)}}, colour, 1.1);
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

void draw_wall(Chart& chart, const IntensityHv& intensity, const std::string& title, const std::string& subtitle,
               const CheckResult* check, bool coloured) {
  Axes axes{62, 52, 700, 372, -21, 21, -6, 5};
  const Grid grid = sample([&](double h, double v) { return log_cd(intensity(h, v)); }, axes.x_min, axes.x_max,
                           axes.y_min, axes.y_max, 701, 373);
  constexpr double kLow = 1.5, kHigh = 5.0;  // 30 cd to 100,000 cd
  if (coloured) {
    chart.picture(axes, grid.x.size(), grid.y.size(), [&](std::size_t i, std::size_t j) {
      return false_colour((grid.values[(grid.y.size() - 1 - j) * grid.x.size() + i] - kLow) / (kHigh - kLow));
    });
  }
  chart.axes(axes, 2, 1, "H in deg, right positive, seen from the lamp (25 m: 1 deg = 0.436 m)",
             "V in deg, up positive", coloured ? Rgb{0.4, 0.4, 0.4} : Rgb{0.8, 0.8, 0.8}, coloured ? 0.25 : 0.4);
  chart.begin_clip(axes);
  double label_at = 0.1;  // labels of crowded lines stand side by side
  for (const double cd : {50.0, 100.0, 200.0, 350.0, 625.0, 1000.0, 2000.0, 5000.0, 10000.0, 20000.0, 30000.0, 40000.0,
                          60000.0, 80000.0}) {
    const Rgb own = false_colour(0.85 * (std::log10(cd) - kLow) / (kHigh - kLow) + 0.05);
    draw_contours(chart, axes, contours(grid.values, grid.x, grid.y, std::log10(cd)),
                  coloured ? Rgb{0.92, 0.92, 0.92} : own, coloured ? 0.7 : 1.1, short_number(cd), true, label_at);
    label_at = label_at > 0.38 ? 0.1 : label_at + 0.05;
  }
  draw_cross(chart, axes, coloured ? Rgb{0.35, 0.85, 1.0} : kBlack);
  if (check != nullptr) draw_rows(chart, axes, *check);
  chart.end_clip();
  chart.text(axes.x(0) + 3, axes.top + 8, "V", 9, -1, coloured ? kWhite : kBlack, true, true);
  chart.text(axes.left + axes.width - 10, axes.y(0) - 8, "H", 9, -1, coloured ? kWhite : kBlack, true, true);
  heading(chart, title, subtitle);
  // Legend: candela, and lux on the wall.
  Axes legend{788, 72, 16, 340, 0, 1, kLow, kHigh};
  chart.text(796, 58, "cd", 9, 0, kBlack, true);
  chart.text(838, 58, "lx 25 m", 9, 0, kBlack, true);
  chart.picture(legend, 1, 256,
                [](std::size_t, std::size_t j) { return false_colour(1.0 - static_cast<double>(j) / 255.0); });
  chart.line({{788, 72}, {804, 72}, {804, 412}, {788, 412}}, kBlack, 0.8, true);
  for (const double cd : {50.0, 100.0, 350.0, 625.0, 1000.0, 3000.0, 10000.0, 30000.0, 100000.0}) {
    const double y = legend.y(std::log10(cd));
    chart.line({{804, y}, {807, y}}, kBlack, 0.8);
    chart.text(785, y, short_number(cd), 8, 1, kBlack);
    char lux[16];
    std::snprintf(lux, sizeof lux, "%.3g", cd / 625.0);
    chart.text(810, y, lux, 8, -1, kBlack);
  }
  if (check != nullptr) {
    chart.circle(560, 20, 3, kPass, 0, true);
    chart.text(568, 20, "pass", 8.5, -1, kBlack);
    chart.line({{598, 17}, {604, 23}}, kFailed, 2);
    chart.line({{598, 23}, {604, 17}}, kFailed, 2);
    chart.text(610, 20, "fail", 8.5, -1, kBlack);
    chart.circle(640, 20, 3, kWithin, 0, true);
    chart.text(648, 20, "within the file's resolution", 8.5, -1, kBlack);
  }
}

void draw_road(Chart& chart, const std::vector<RoadLamp>& lamps, const std::string& title,
               const std::string& subtitle) {
  heading(chart, title, subtitle);
  const double levels[] = {1, 3, 5, 10, 30, 50, 100};
  for (const int panel : {0, 1}) {
    const bool facing = panel == 1;
    const double ahead = facing ? 160.0 : 80.0;
    const double side = facing ? 25.0 : 15.0;
    Axes axes{panel == 0 ? 62.0 : 472.0, 74, 340, 336, side, -side, 0, ahead};  // y to the left is left on the page
    const Grid grid =
        sample([&](double y,
                   double x) { return std::log10(std::max(road_lux(lamps, x, y, facing ? 0.25 : 0.0, facing), 1e-4)); },
               axes.x_min, axes.x_max, std::max(0.5, axes.y_min), axes.y_max, 241, 321);
    chart.picture(axes, grid.x.size(), grid.y.size(), [&](std::size_t i, std::size_t j) {
      return false_colour((grid.values[(grid.y.size() - 1 - j) * grid.x.size() + i] + 1.0) / 3.2);  // 0.1 to 160 lx
    });
    chart.begin_clip(axes);
    for (const double lane : {-5.25, -1.75, 1.75})
      chart.line({{axes.x(lane), axes.top}, {axes.x(lane), axes.top + axes.height}}, {0.75, 0.75, 0.75}, 0.8, false,
                 true);
    for (const double lx : levels) {
      const bool main = lx <= 5.0;
      draw_contours(chart, axes, contours(grid.values, grid.x, grid.y, std::log10(lx)),
                    main ? Rgb{0.4, 1.0, 0.55} : kWhite, main ? 1.4 : 0.8, short_number(lx) + " lx", true);
    }
    for (const RoadLamp& lamp : lamps) chart.circle(axes.x(lamp.y_m), axes.y(0.0), 3, kWhite, 0.0, true);
    chart.end_clip();
    chart.axes(axes, 5, facing ? 20 : 10, "y in m, left positive", "x ahead of the lamps in m", {0.5, 0.5, 0.5}, 0.2);
    chart.text(axes.left, 62, facing ? "E facing the car (vertical plane, 0.25 m high)" : "E on the road (horizontal)",
               10, -1, kBlack, true);
  }
  chart.text(430, 459, "isolux 1, 3, 5, 10, 30, 50, 100 lx; dashed: lanes of 3.5 m, car in the middle of the right one",
             8.5, 0, {0.3, 0.3, 0.3});
}

void draw_cut(Chart& chart, const IntensityHv& intensity, double h_deg, const std::string& title,
              const std::string& subtitle) {
  heading(chart, title, subtitle);
  Axes axes{82, 52, 620, 372, -3, 2, 1.5, 5};
  chart.axes(axes, 0.5, 0, "V in deg", "intensity in cd (log)", {0.85, 0.85, 0.85}, 0.4);
  for (const double cd : {50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0, 5000.0, 10000.0, 20000.0, 50000.0, 100000.0}) {
    const double y = axes.y(std::log10(cd));
    if (y < axes.top - 1 || y > axes.top + axes.height + 1) continue;
    chart.line({{axes.left, y}, {axes.left + axes.width, y}}, {0.85, 0.85, 0.85}, 0.4);
    chart.text(axes.left - 5, y, short_number(cd), 9, 1, kBlack);
  }
  Axes g_axes = axes;
  g_axes.y_min = 0.0;
  g_axes.y_max = 0.6;
  constexpr Rgb kBlue{0.1, 0.25, 0.75}, kOrange{0.85, 0.4, 0.0};
  std::vector<std::array<double, 2>> curve, sharpness;
  for (double v = axes.x_min; v <= axes.x_max + 1e-9; v += 0.01) {
    curve.push_back({axes.x(v), axes.y(log_cd(intensity(h_deg, v)))});
    const double g = log_cd(intensity(h_deg, v - 0.05)) - log_cd(intensity(h_deg, v + 0.05));
    sharpness.push_back({g_axes.x(v), g_axes.y(std::max(g, 0.0))});
  }
  chart.begin_clip(axes);
  for (const double limit : {0.13, 0.40}) {
    chart.line({{axes.left, g_axes.y(limit)}, {axes.left + axes.width, g_axes.y(limit)}}, kOrange, 0.9, false, true);
    chart.text(axes.left + 6, g_axes.y(limit) - 6, limit < 0.2 ? "G 0.13 (least)" : "G 0.40 (most)", 8.5, -1, kOrange);
  }
  chart.line(sharpness, kOrange, 1.4);
  chart.line(curve, kBlue, 2.0);
  const Cutoff cutoff = find_cutoff(intensity, h_deg);
  if (cutoff.found) {
    chart.line({{axes.x(cutoff.elevation_deg), axes.top}, {axes.x(cutoff.elevation_deg), axes.top + axes.height}},
               kPass, 1.2, false, true);
    char text[96];
    std::snprintf(text, sizeof text, "inflection at %+.3f deg, G = %.3f", cutoff.elevation_deg, cutoff.sharpness_g);
    chart.text(axes.x(cutoff.elevation_deg) + 6, axes.top + 14, text, 10, -1, kPass, true, true);
  }
  chart.end_clip();
  for (double g = 0.0; g <= 0.601; g += 0.1) {
    char text[16];
    std::snprintf(text, sizeof text, "%.1f", g);
    chart.text(axes.left + axes.width + 6, g_axes.y(g), text, 9, -1, kOrange);
  }
  chart.vertical_text(axes.left + axes.width + 34, axes.top + 0.5 * axes.height, "G = log E(V-0.05) - log E(V+0.05)",
                      10, kOrange);
}

void draw_bands(Chart& chart, const IntensityHv& intensity, const std::string& title, const std::string& subtitle) {
  heading(chart, title, subtitle);
  Axes axes{62, 52, 700, 372, -50, 50, -20, 15};
  const double edges[] = {30, 100, 300, 625, 1000, 2000, 5000, 10000, 20000, 40000, 80000};
  constexpr std::size_t kBands = 12;
  const auto band = [&](double cd) {
    return static_cast<std::size_t>(std::upper_bound(std::begin(edges), std::end(edges), cd) - std::begin(edges));
  };
  const auto colour = [](std::size_t b) { return false_colour(static_cast<double>(b) / (kBands - 1)); };
  const Grid grid = sample(intensity, axes.x_min, axes.x_max, axes.y_min, axes.y_max, 701, 373);
  chart.picture(axes, grid.x.size(), grid.y.size(), [&](std::size_t i, std::size_t j) {
    return colour(band(grid.values[(grid.y.size() - 1 - j) * grid.x.size() + i]));
  });
  chart.begin_clip(axes);
  draw_cross(chart, axes, {0.35, 0.85, 1.0});
  chart.end_clip();
  chart.axes(axes, 10, 5, "H in deg, right positive", "V in deg, up positive", {0.5, 0.5, 0.5}, 0.2);
  chart.text(806, 60, "cd", 9, 0, kBlack, true);
  for (std::size_t b = 0; b < kBands; ++b) {
    const double y = 412.0 - 28.0 * static_cast<double>(b);
    chart.rectangle(782, y - 28, 18, 28, colour(b));
    if (b + 1 < kBands) chart.text(804, y - 28, short_number(edges[b]), 8.5, -1, kBlack);
  }
  chart.line({{782, 412 - 28.0 * kBands}, {800, 412 - 28.0 * kBands}, {800, 412}, {782, 412}}, kBlack, 0.8, true);
}

void draw_ratio(Chart& chart, const IntensityHv& a, const IntensityHv& b, const std::string& title,
                const std::string& subtitle) {
  heading(chart, title, subtitle);
  Axes axes{62, 52, 700, 372, -21, 21, -6, 5};
  const Grid grid = sample(
      [&](double h, double v) {
        const double x = a(h, v), y = b(h, v);
        return x < 1.0 && y < 1.0 ? 0.0 : std::log2(std::max(y, 0.1) / std::max(x, 0.1));
      },
      axes.x_min, axes.x_max, axes.y_min, axes.y_max, 701, 373);
  const auto colour = [](double octaves) {
    const double t = std::clamp(octaves / 2.0, -1.0, 1.0);  // a quarter to four times
    return t < 0.0 ? Rgb{1.0 + t * 0.9, 1.0 + t * 0.65, 1.0 + t * 0.2}
                   : Rgb{1.0 - t * 0.2, 1.0 - t * 0.85, 1.0 - t * 0.85};
  };
  chart.picture(axes, grid.x.size(), grid.y.size(), [&](std::size_t i, std::size_t j) {
    return colour(grid.values[(grid.y.size() - 1 - j) * grid.x.size() + i]);
  });
  chart.begin_clip(axes);
  for (const double ratio : {0.25, 0.5, 0.8, 0.9, 1.1, 1.25, 2.0, 4.0})
    draw_contours(chart, axes, contours(grid.values, grid.x, grid.y, std::log2(ratio)), {0.25, 0.25, 0.25}, 0.6,
                  short_number(ratio), true);
  draw_cross(chart, axes, kBlack);
  chart.end_clip();
  chart.axes(axes, 2, 1, "H in deg, right positive", "V in deg, up positive", {0.6, 0.6, 0.6}, 0.2);
  Axes legend{788, 72, 16, 340, 0, 1, -2, 2};
  chart.text(800, 58, "B / A", 9, 0, kBlack, true);
  chart.picture(legend, 1, 256,
                [&](std::size_t, std::size_t j) { return colour(2.0 - 4.0 * static_cast<double>(j) / 255.0); });
  chart.line({{788, 72}, {804, 72}, {804, 412}, {788, 412}}, kBlack, 0.8, true);
  for (const double ratio : {0.25, 0.5, 1.0, 2.0, 4.0})
    chart.text(809, legend.y(std::log2(ratio)), short_number(ratio), 8.5, -1, kBlack);
}

void draw_difference(Chart& chart, const IntensityHv& a, const IntensityHv& b, const std::vector<RoadLamp>& road_a,
                     const std::vector<RoadLamp>& road_b, const std::string& title, const std::string& subtitle) {
  heading(chart, title, subtitle);
  // Signed and logarithmic beyond one unit: what is small stays white, what is large does not drown the rest.
  const auto signed_log = [](double value) { return std::copysign(std::log10(1.0 + std::abs(value)), value); };
  const auto colour = [](double t) {
    t = std::clamp(t, -1.0, 1.0);
    return t < 0.0 ? Rgb{1.0 + t * 0.9, 1.0 + t * 0.65, 1.0 + t * 0.2}
                   : Rgb{1.0 - t * 0.2, 1.0 - t * 0.85, 1.0 - t * 0.85};
  };
  const auto panel = [&](const Axes& axes, const Grid& grid, double full, const std::vector<double>& levels,
                         double unit, const std::string& unit_name) {
    chart.picture(axes, grid.x.size(), grid.y.size(), [&](std::size_t i, std::size_t j) {
      return colour(grid.values[(grid.y.size() - 1 - j) * grid.x.size() + i] / full);
    });
    chart.begin_clip(axes);
    double label_at = 0.1;
    for (const double level : levels) {
      for (const double sign : {-1.0, 1.0}) {
        const std::string name = (sign < 0.0 ? "-" : "+") + short_number(level) + unit_name;
        draw_contours(chart, axes, contours(grid.values, grid.x, grid.y, signed_log(sign * level / unit)),
                      {0.25, 0.25, 0.25}, 0.7, name, true, label_at);
        label_at = label_at > 0.5 ? 0.1 : label_at + 0.08;
      }
    }
    chart.end_clip();
  };
  Axes wall{62, 74, 400, 336, -15, 15, -5, 4};
  const Grid candela = sample([&](double h, double v) { return signed_log((b(h, v) - a(h, v)) / 100.0); }, wall.x_min,
                              wall.x_max, wall.y_min, wall.y_max, 501, 301);
  panel(wall, candela, signed_log(100.0), {300, 1000, 3000, 10000}, 100.0, "");
  draw_cross(chart, wall, kBlack);
  chart.axes(wall, 5, 1, "H in deg, right positive", "V in deg, up positive", {0.6, 0.6, 0.6}, 0.2);
  chart.text(wall.left, 62, "B - A in cd", 10, -1, kBlack, true);
  Axes road{532, 74, 290, 336, 20, -20, 0, 120};
  const Grid lux = sample(
      [&](double y, double x) {
        return signed_log(road_lux(road_b, x, y, 0.25, true) - road_lux(road_a, x, y, 0.25, true));
      },
      road.x_min, road.x_max, 2.0, road.y_max, 241, 301);
  panel(road, lux, signed_log(30.0), {1, 3, 10, 30}, 1.0, " lx");
  chart.axes(road, 5, 20, "y in m, left positive", "x ahead of the lamps in m", {0.6, 0.6, 0.6}, 0.2);
  chart.text(road.left, 62, "B - A in lx facing the car, pair, 0.25 m high", 10, -1, kBlack, true);
  chart.text(430, 459, "red: B gives more, blue: B gives less; signed logarithm of the difference", 8.5, 0,
             {0.3, 0.3, 0.3});
}

}  // namespace phare
