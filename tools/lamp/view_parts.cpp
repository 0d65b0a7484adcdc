#include "tools/lamp/view_parts.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string_view>

namespace phare {

std::string short_number(double value) {
  char text[32];
  if (value >= 10000.0) {
    std::snprintf(text, sizeof text, "%gk", value / 1000.0);
  } else {
    std::snprintf(text, sizeof text, "%g", value);
  }
  return text;
}

Grid sample_grid(const std::function<double(double, double)>& f, double x_min, double x_max, double y_min, double y_max,
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

void draw_no_data_note(Chart& chart, double x, double y, const Grid& grid) {
  const bool some = std::any_of(grid.values.begin(), grid.values.end(), [](double v) { return std::isnan(v); });
  if (!some) return;
  chart.rectangle(x, y - 5, 14, 10, kNoDataColour);
  chart.text(x + 19, y, "no data in the file", 8.5, -1, kBlack);
}

namespace {

/// Where the second line of a text begins that is too wide: after the last semicolon that fits, else the last blank;
/// its size where there is neither.
std::size_t line_break(const Chart& chart, const std::string& text, double size, double room) {
  for (const std::string_view mark : {"; ", " "}) {
    std::size_t part = 0;
    for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + 1)) {
      if (chart.width_of(text.substr(0, at + 1), size) > room) break;
      part = at + mark.size();
    }
    if (part > 0) return part;
  }
  return text.size();
}

}  // namespace

void heading(Chart& chart, const std::string& title, const std::string& subtitle) {
  constexpr double kLeft = 62.0, kRoom = kPageWidth - kLeft - 10.0;
  constexpr Rgb kDark{0.3, 0.3, 0.3};
  // No text leaves the page: what is too long gets smaller.
  const auto fitting = [&](const std::string& text, double size, bool bold) {
    return size * std::min(1.0, kRoom / std::max(chart.width_of(text, size, bold), 1.0));
  };
  const bool two = chart.width_of(subtitle, 9) > kRoom;
  chart.text(kLeft, two ? 16 : 20, title, fitting(title, 13, true), -1, kBlack, true);
  if (!two) return chart.text(kLeft, 38, subtitle, 9, -1, kDark);
  const std::size_t part = line_break(chart, subtitle, 9, kRoom);
  const std::string first = subtitle.substr(0, part), rest = subtitle.substr(part);
  chart.text(kLeft, 32, first, fitting(first, 9, false), -1, kDark);
  chart.text(kLeft, 43, rest, fitting(rest, 9, false), -1, kDark);
}

void colour_bar(Chart& chart, double left, double top, double height, double low, double high,
                const std::function<Rgb(double)>& colour, const std::vector<BarMark>& marks) {
  constexpr double kWidth = 14.0;
  const Axes bar{left, top, kWidth, height, 0, 1, low, high};
  chart.picture(bar, 1, 256, [&](std::size_t, std::size_t j) {
    return colour(high + (low - high) * static_cast<double>(j) / 255.0);
  });
  chart.line({{left, top}, {left + kWidth, top}, {left + kWidth, top + height}, {left, top + height}}, kBlack, 0.8,
             true);
  for (const BarMark& mark : marks) {
    const double y = bar.y(mark.value);
    if (y < top - 0.5 || y > top + height + 0.5) continue;
    if (!mark.right.empty()) chart.line({{left + kWidth, y}, {left + kWidth + 3, y}}, kBlack, 0.8);
    chart.text(left - 3, y, mark.left, 8, 1, kBlack);
    chart.text(left + kWidth + 5, y, mark.right, 8, -1, kBlack);
  }
}

Rgb difference_colour(double t) {
  if (std::isnan(t)) return kNoDataColour;
  t = std::clamp(t, -1.0, 1.0);
  return t < 0.0 ? Rgb{1.0 + t * 0.9, 1.0 + t * 0.65, 1.0 + t * 0.2}
                 : Rgb{1.0 - t * 0.2, 1.0 - t * 0.85, 1.0 - t * 0.85};
}

}  // namespace phare
