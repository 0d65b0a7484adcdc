// Views of a beam by direction: 25 m wall, vertical cut, false colour, ratio of two.
// Computes: I(H, V) of the lamp as mounted; E = I/625 lx at 25 m. Leaves out: everything but the direct light.
#include "tools/lamp/views.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "visual/photometry/bench/cutoff_line.h"

namespace phare {
namespace {

constexpr Axes kWall{62, 52, 700, 372, -21, 21, -6, 5};
constexpr Rgb kText{0.3, 0.3, 0.3};

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

bool has_data(const IntensityHv& intensity, double h_deg, double v_deg) {
  return !intensity.evidence || intensity.evidence(h_deg, v_deg) != Evidence::kNone;
}

double log_cd(double cd) {
  return std::log10(std::max(cd, 1e-3));
}

Rgb verdict_colour(RuleVerdict verdict) {
  switch (verdict) {
    case RuleVerdict::kPass:
      return kPass;
    case RuleVerdict::kFail:
      return kFailed;
    case RuleVerdict::kWithinResolution:
      return kWithin;
    case RuleVerdict::kNoData:
      break;
  }
  return kGrey;
}

/// Corners of a row's place, H and V.
std::vector<HV> outline(const CheckRow& row) {
  if (row.shape != RowShape::kArea || row.at.size() < 2) return row.at;
  const HV a = row.at[0], b = row.at[1];
  return {{a.h_deg, a.v_deg}, {b.h_deg, a.v_deg}, {b.h_deg, b.v_deg}, {a.h_deg, b.v_deg}};
}

bool is_outline(const CheckRow& row) {
  return row.shape == RowShape::kPolygon || row.shape == RowShape::kArea || row.shape == RowShape::kLine;
}

void draw_cross(Chart& chart, const Axes& axes, Rgb colour) {
  chart.line({{axes.x(0), axes.top}, {axes.x(0), axes.top + axes.height}}, colour, 1.1);
  chart.line({{axes.left, axes.y(0)}, {axes.left + axes.width, axes.y(0)}}, colour, 1.1);
}

void draw_mark(Chart& chart, double x, double y, RuleVerdict verdict) {
  const Rgb colour = verdict_colour(verdict);
  if (verdict == RuleVerdict::kFail) {
    for (const auto& [rim, width] : {std::pair{kWhite, 3.4}, {colour, 2.0}}) {
      chart.line({{x - 4, y - 4}, {x + 4, y + 4}}, rim, width);
      chart.line({{x - 4, y + 4}, {x + 4, y - 4}}, rim, width);
    }
  } else {
    chart.circle(x, y, 3.4, kWhite, 0.0, true);
    chart.circle(x, y, 2.6, colour, 0.0, true);
  }
}

/// Where the name of an outline may stand: along its edges, beside them.
std::vector<LabelPlace> places_along(const Axes& axes, const std::vector<HV>& corners, bool closed) {
  std::vector<LabelPlace> places;
  const std::size_t edges = closed ? corners.size() : corners.size() - 1;
  for (const double part : {0.02, 0.35, 0.65, 0.98, 0.2, 0.5, 0.8}) {
    for (std::size_t i = 0; i < edges; ++i) {
      const HV a = corners[i], b = corners[(i + 1) % corners.size()];
      const double x = axes.x(a.h_deg + part * (b.h_deg - a.h_deg)), y = axes.y(a.v_deg + part * (b.v_deg - a.v_deg));
      for (const double aside : {-6.0, 7.0}) {
        for (const int align : {-1, 1, 0}) places.push_back({x - 3.0 * align, y + aside, align});
      }
    }
  }
  return places;
}

/// Rows where they are looked at: outlines solid where light is limited, dashed where it is asked for; points as marks.
void draw_rows(Chart& chart, const Axes& axes, const CheckResult& check) {
  for (const CheckRow& row : check.rows) {
    if (row.at.empty() || !is_outline(row)) continue;
    std::vector<std::array<double, 2>> points;
    for (const HV p : outline(row)) points.push_back({axes.x(p.h_deg), axes.y(p.v_deg)});
    const bool closed = row.shape != RowShape::kLine, at_least = row.max >= kNoMaximum;
    chart.line(points, kWhite, 3.2, closed, at_least);  // a rim, to stand out from the beam's colours
    chart.line(points, verdict_colour(row.verdict), 1.6, closed, at_least);
  }
  const auto is_point = [](const CheckRow& row) {
    return row.shape == RowShape::kPoints || row.shape == RowShape::kSum;
  };
  for (const CheckRow& row : check.rows) {
    if (!is_point(row)) continue;
    for (const HV p : row.at) {
      draw_mark(chart, axes.x(p.h_deg), axes.y(p.v_deg), row.verdict);
      chart.keep_free(axes.x(p.h_deg) - 3.5, axes.y(p.v_deg) - 3.5, 7, 7);
    }
  }
  // Failed rows are named first, then points, then outlines: what matters finds a place.
  for (const bool failed : {true, false}) {
    for (const bool points : {true, false}) {
      for (const CheckRow& row : check.rows) {
        if (row.at.empty() || (row.verdict == RuleVerdict::kFail) != failed || is_point(row) != points) continue;
        const Rgb colour = failed ? kFailed : kBlack;
        if (!points && is_outline(row)) {
          chart.label(places_along(axes, outline(row), row.shape != RowShape::kLine), row.id, 7, colour);
          continue;
        }
        for (const HV p : row.at) {
          const double x = axes.x(p.h_deg), y = axes.y(p.v_deg);
          std::vector<LabelPlace> places;
          for (const double away : {6.5, 13.0, 20.0}) {
            for (const double up : {-away, away}) {
              for (const int align : {-1, 1, 0}) places.push_back({x - 5.0 * align, y + up, align});
            }
          }
          places.push_back({x + 6, y, -1});
          places.push_back({x - 6, y, 1});
          const bool named = chart.label(places, row.id, 7, colour);
          if (row.shape == RowShape::kSum && named) break;
        }
      }
    }
  }
}

/// The cut-off as scans in 0.25° find it, as far as it hangs together, and the kink.
void draw_cutoff_line(Chart& chart, const Axes& axes, const IntensityHv& intensity) {
  constexpr Rgb kColour{0.85, 0.1, 0.75};
  const CutoffLine line = cutoff_line(intensity, -12.0, 12.0, 0.25);
  std::vector<std::array<double, 2>> piece;
  const auto flush = [&] {
    if (piece.size() > 1) chart.line(piece, kColour, 1.3, false, true);
    piece.clear();
  };
  for (std::size_t i = 0; i < line.h_deg.size(); ++i) {
    const bool gap =
        i > 0 && (line.h_deg[i] - line.h_deg[i - 1] > 0.3 || std::abs(line.v_deg[i] - line.v_deg[i - 1]) > 1.0);
    if (gap) flush();
    piece.push_back({axes.x(line.h_deg[i]), axes.y(line.v_deg[i])});
  }
  flush();
  const CutoffShape shape = cutoff_shape(intensity);
  if (!shape.tells_side()) return;
  const double side = shape.side == CutoffSide::kRisesRight ? -1.0 : 1.0;
  const double x = axes.x(shape.kink_h_deg), y = axes.y(shape.flat_v_deg);
  chart.circle(x, y, 3.2, kColour, 1.4);
  chart.label({{x + 12.0 * side, y + 12, side < 0 ? 1 : -1}, {x + 12.0 * side, y + 22, side < 0 ? 1 : -1}},
              "kink, " + form_name(shape.form), 8, kColour, false);
}

void draw_row_legend(Chart& chart, const CheckResult& check) {
  constexpr double y = 466.0;
  double x = 70.0;
  for (const auto& [verdict, name, wide] : {std::tuple{RuleVerdict::kPass, "pass", 45.0},
                                            {RuleVerdict::kFail, "fail", 45.0},
                                            {RuleVerdict::kWithinResolution, "within the file's resolution", 150.0},
                                            {RuleVerdict::kNoData, "no data", 65.0}}) {
    draw_mark(chart, x, y, verdict);
    const bool points =
        verdict == RuleVerdict::kNoData &&
        std::any_of(check.rows.begin(), check.rows.end(), [](const CheckRow& r) { return r.not_measured; });
    chart.text(x + 8, y, points ? "not measured" : name, 8.5, -1, kBlack);
    x += points ? wide + 30.0 : wide;
  }
  chart.line({{x, y}, {x + 24, y}}, kBlack, 1.5);
  chart.text(x + 29, y, "light at most", 8.5, -1, kBlack);
  x += 115;
  chart.line({{x, y}, {x + 24, y}}, kBlack, 1.5, false, true);
  chart.text(x + 29, y, "light at least", 8.5, -1, kBlack);
  const std::vector<std::string> beyond = rows_beyond_wall(check);
  if (beyond.empty()) return;
  std::string text = "not wholly on this page: ";
  for (std::size_t i = 0; i < beyond.size(); ++i) {
    if (text.size() > 130) {
      text += " and " + std::to_string(beyond.size() - i) + " more";
      break;
    }
    const auto row =
        std::find_if(check.rows.begin(), check.rows.end(), [&](const CheckRow& r) { return r.id == beyond[i]; });
    text += (i > 0 ? ", " : "") + beyond[i] + " (" +
            (row->verdict == RuleVerdict::kFail ? "FAIL" : verdict_name(*row)) + ")";
  }
  chart.text(66, 481, text, 8.5, -1, kText);
}

}  // namespace

std::vector<std::string> rows_beyond_wall(const CheckResult& check) {
  std::vector<std::string> ids;
  std::ptrdiff_t failed = 0;
  for (const CheckRow& row : check.rows) {
    const bool out = std::any_of(row.at.begin(), row.at.end(), [](HV p) {
      return p.h_deg < kWall.x_min || p.h_deg > kWall.x_max || p.v_deg < kWall.y_min || p.v_deg > kWall.y_max;
    });
    if (out) ids.insert(row.verdict == RuleVerdict::kFail ? ids.begin() + failed++ : ids.end(), row.id);
  }
  return ids;
}

void draw_wall(Chart& chart, const IntensityHv& intensity, const std::string& title, const std::string& subtitle,
               const CheckResult* check, bool coloured) {
  const Axes axes = kWall;
  const Grid grid =
      sample_grid([&](double h, double v) { return has_data(intensity, h, v) ? log_cd(intensity(h, v)) : kNoValue; },
                  axes.x_min, axes.x_max, axes.y_min, axes.y_max, 701, 373);
  constexpr double kLow = 1.5, kHigh = 5.0;  // 30 cd to 100,000 cd
  const auto colour = [](double log) { return chart_colour((log - kLow) / (kHigh - kLow)); };
  chart.picture(axes, grid.x.size(), grid.y.size(), [&](std::size_t i, std::size_t j) {
    const double log = grid.at_pixel(i, j);
    return std::isnan(log) ? kNoDataColour : coloured ? colour(log) : kWhite;
  });
  chart.axes(axes, 2, 1, "H in deg, right positive, seen from the lamp (25 m: 1 deg = 0.436 m)",
             "V in deg, up positive", coloured ? Rgb{0.4, 0.4, 0.4} : Rgb{0.8, 0.8, 0.8}, coloured ? 0.25 : 0.4);
  chart.begin_clip(axes);
  std::vector<PendingLabel> labels;
  for (const double cd : {50.0, 100.0, 200.0, 350.0, 625.0, 1000.0, 2000.0, 5000.0, 10000.0, 20000.0, 30000.0, 40000.0,
                          60000.0, 80000.0}) {
    const Rgb own = chart_colour(0.85 * (std::log10(cd) - kLow) / (kHigh - kLow) + 0.05);
    draw_contours(chart, axes, contours(grid.values, grid.x, grid.y, std::log10(cd)),
                  coloured ? Rgb{0.92, 0.92, 0.92} : own, coloured ? 0.7 : 1.1, short_number(cd), labels);
  }
  draw_cross(chart, axes, coloured ? Rgb{0.35, 0.85, 1.0} : kBlack);
  const Rgb cross_name = coloured ? kWhite : kBlack;
  chart.label({{axes.x(0) + 3, axes.top + 8, -1}}, "V", 9, cross_name);
  chart.label({{axes.left + axes.width - 4, axes.y(0) - 8, 1}}, "H", 9, cross_name);
  if (!coloured) draw_cutoff_line(chart, axes, intensity);
  if (check != nullptr) draw_rows(chart, axes, *check);
  draw_labels(chart, labels);
  chart.end_clip();
  heading(chart, title, subtitle);
  chart.text(786, 58, "cd", 9, 1, kBlack, true);
  chart.text(807, 58, "lx, 25 m", 9, -1, kBlack, true);
  std::vector<BarMark> marks;
  for (const double cd : {50.0, 100.0, 350.0, 625.0, 1000.0, 3000.0, 10000.0, 30000.0, 100000.0}) {
    char lux[16];
    std::snprintf(lux, sizeof lux, "%.3g", cd / 625.0);
    marks.push_back({std::log10(cd), short_number(cd), lux});
  }
  colour_bar(chart, 790, 72, 340, kLow, kHigh, colour, marks);
  if (check != nullptr) draw_row_legend(chart, *check);
  draw_no_data_note(chart, 640, 466, grid);
}

void draw_point_wall(Chart& chart, const std::vector<PointMark>& points, const std::string& title,
                     const std::string& subtitle, const CheckResult* check) {
  const Axes axes = kWall;
  chart.rectangle(axes.left, axes.top, axes.width, axes.height, kWhite);
  chart.axes(axes, 2, 1, "H in deg, right positive, seen from the lamp (25 m: 1 deg = 0.436 m)",
             "V in deg, up positive", {0.8, 0.8, 0.8}, 0.4);
  chart.begin_clip(axes);
  draw_cross(chart, axes, kBlack);
  for (const PointMark& point : points) chart.keep_free(axes.x(point.at.h_deg) - 5, axes.y(point.at.v_deg) - 5, 10, 10);
  if (check != nullptr) draw_rows(chart, axes, *check);
  std::size_t beyond = 0;
  for (const PointMark& point : points) {
    const double x = axes.x(point.at.h_deg), y = axes.y(point.at.v_deg);
    if (point.at.h_deg < axes.x_min || point.at.h_deg > axes.x_max || point.at.v_deg < axes.y_min ||
        point.at.v_deg > axes.y_max) {
      ++beyond;
      continue;
    }
    chart.circle(x, y, 4.6, kBlack, 1.0);
    std::vector<LabelPlace> places;
    for (const double away : {11.0, 18.0, 26.0}) {
      for (const double up : {away, -away}) {
        for (const int align : {0, -1, 1}) places.push_back({x - 4.0 * align, y + up, align});
      }
    }
    char value[32];
    std::snprintf(value, sizeof value, "%.4g cd", point.cd);
    if (point.cd >= 1000.0) std::snprintf(value, sizeof value, "%.0f cd", point.cd);
    chart.label(places, value, 7.5, {0.1, 0.25, 0.75}, false);
  }
  chart.end_clip();
  heading(chart, title, subtitle);
  if (check != nullptr) draw_row_legend(chart, *check);
  chart.circle(640, 466, 4.0, kBlack, 1.0);
  chart.text(650, 466, beyond == 0 ? "measured" : "measured; " + std::to_string(beyond) + " beyond this page", 8.5, -1,
             kBlack);
}

void draw_cut(Chart& chart, const IntensityHv& intensity, double h_deg, const SharpnessLimits& limits,
              const std::string& title, const std::string& subtitle) {
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
  for (const auto& [limit, word] : {std::pair{limits.least, "least"}, {limits.most, "most"}}) {
    if (!(limit > 0.0) || limit >= kNoMaximum) continue;
    char text[120];
    std::snprintf(text, sizeof text, "G %.2f (%s, %s)", limit, word, limits.of.c_str());
    chart.line({{axes.left, g_axes.y(limit)}, {axes.left + axes.width, g_axes.y(limit)}}, kOrange, 0.9, false, true);
    chart.label({{axes.left + 6, g_axes.y(limit) - 6, -1}, {axes.left + 6, g_axes.y(limit) + 7, -1}}, text, 8.5,
                kOrange, false);
  }
  chart.line(sharpness, kOrange, 1.4);
  chart.line(curve, kBlue, 2.0);
  const Cutoff cutoff = find_cutoff(intensity, h_deg);
  if (cutoff.found) {
    const double x = axes.x(cutoff.elevation_deg);
    chart.line({{x, axes.top}, {x, axes.top + axes.height}}, kPass, 1.2, false, true);
    char text[96];
    std::snprintf(text, sizeof text, "inflection at %+.3f deg, G = %.3f", cutoff.elevation_deg, cutoff.sharpness_g);
    chart.label({{x + 6, axes.top + 14, -1}, {x - 6, axes.top + 14, 1}}, text, 10, kPass);
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
  const auto colour = [](std::size_t b) { return chart_colour(static_cast<double>(b) / (kBands - 1)); };
  const Grid grid =
      sample_grid([&](double h, double v) { return has_data(intensity, h, v) ? intensity(h, v) : kNoValue; },
                  axes.x_min, axes.x_max, axes.y_min, axes.y_max, 701, 373);
  chart.picture(axes, grid.x.size(), grid.y.size(), [&](std::size_t i, std::size_t j) {
    const double cd = grid.at_pixel(i, j);
    return std::isnan(cd) ? kNoDataColour : colour(band(cd));
  });
  chart.begin_clip(axes);
  draw_cross(chart, axes, {0.35, 0.85, 1.0});
  chart.end_clip();
  chart.axes(axes, 10, 5, "H in deg, right positive", "V in deg, up positive", {0.5, 0.5, 0.5}, 0.2);
  chart.text(786, 62, "cd", 9, 1, kBlack, true);
  chart.text(807, 62, "lx, 25 m", 9, -1, kBlack, true);
  for (std::size_t b = 0; b < kBands; ++b) {
    const double y = 412.0 - 28.0 * static_cast<double>(b);
    chart.rectangle(790, y - 28, 14, 28, colour(b));
    if (b + 1 == kBands) continue;
    char lux[16];
    std::snprintf(lux, sizeof lux, "%.3g", edges[b] / 625.0);
    chart.text(787, y - 28, short_number(edges[b]), 8, 1, kBlack);
    chart.text(809, y - 28, lux, 8, -1, kBlack);
  }
  chart.line({{790, 412 - 28.0 * kBands}, {804, 412 - 28.0 * kBands}, {804, 412}, {790, 412}}, kBlack, 0.8, true);
  draw_no_data_note(chart, 640, 466, grid);
}

void draw_ratio(Chart& chart, const IntensityHv& a, const IntensityHv& b, const std::string& title,
                const std::string& subtitle) {
  heading(chart, title, subtitle);
  const Axes axes = kWall;
  const Grid grid = sample_grid(
      [&](double h, double v) {
        if (!has_data(a, h, v) || !has_data(b, h, v)) return kNoValue;
        const double x = a(h, v), y = b(h, v);
        return x < 1.0 && y < 1.0 ? 0.0 : std::log2(std::max(y, 0.1) / std::max(x, 0.1));
      },
      axes.x_min, axes.x_max, axes.y_min, axes.y_max, 701, 373);
  const auto colour = [](double octaves) { return difference_colour(octaves / 2.0); };  // a quarter to four times
  chart.picture(axes, grid.x.size(), grid.y.size(),
                [&](std::size_t i, std::size_t j) { return colour(grid.at_pixel(i, j)); });
  chart.begin_clip(axes);
  std::vector<PendingLabel> labels;
  for (const double ratio : {0.25, 0.5, 0.8, 0.9, 1.1, 1.25, 2.0, 4.0})
    draw_contours(chart, axes, contours(grid.values, grid.x, grid.y, std::log2(ratio)), {0.25, 0.25, 0.25}, 0.6,
                  short_number(ratio), labels);
  draw_cross(chart, axes, kBlack);
  draw_labels(chart, labels);
  chart.end_clip();
  chart.axes(axes, 2, 1, "H in deg, right positive", "V in deg, up positive", {0.6, 0.6, 0.6}, 0.2);
  chart.text(800, 58, "B / A", 9, 0, kBlack, true);
  std::vector<BarMark> marks;
  for (const double ratio : {0.25, 0.5, 0.8, 1.0, 1.25, 2.0, 4.0})
    marks.push_back({std::log2(ratio), "", short_number(ratio)});
  colour_bar(chart, 790, 72, 340, -2, 2, colour, marks);
  double least = 0.0, most = 0.0;
  for (const double octaves : grid.values) {
    if (std::isnan(octaves)) continue;
    least = std::min(least, octaves);
    most = std::max(most, octaves);
  }
  char extremes[120];
  std::snprintf(extremes, sizeof extremes, "B / A on this page: %.3g to %.3g; 1 where both are below 1 cd",
                std::exp2(least), std::exp2(most));
  chart.text(66, 466, extremes, 8.5, -1, kText);
  draw_no_data_note(chart, 640, 466, grid);
}

}  // namespace phare
