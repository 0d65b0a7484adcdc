#include "tools/time_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tools/html_text.h"

namespace phare {
namespace {

constexpr double kWidth = 1060, kHeight = 230, kLeft = 58, kRight = 14, kTop = 34, kBottom = 34;
constexpr std::array<const char*, 8> kInks{"#e8a53a", "#4fa3e0", "#7fbf5a", "#d96fae",
                                           "#b58cf0", "#3fbfb0", "#e0694f", "#9aa4b2"};

struct Scale {
  double low, high, from_px, to_px;
  double operator()(double value) const { return from_px + (value - low) / (high - low) * (to_px - from_px); }
};

/// "M x y L x y …", broken where there is no value.
std::string path_of(const TimeSeries& line, const Scale& x, const Scale& y) {
  std::string path;
  bool down = false;
  const auto to = [&](double x_px, double value) {
    path += fmt::format("{}{:.1f} {:.1f}", down ? "L" : "M", x_px, y(value));
    down = true;
  };
  for (std::size_t i = 0; i < line.value.size();) {
    if (std::isnan(line.value[i])) {
      down = false, ++i;
      continue;
    }
    // All that falls into one column of the picture: first, least, greatest, last.
    const double column = std::floor(x(line.time_s[i]));
    std::size_t end = i, least = i, most = i;
    for (; end < line.value.size() && !std::isnan(line.value[end]) && std::floor(x(line.time_s[end])) == column;
         ++end) {
      if (line.value[end] < line.value[least]) least = end;
      if (line.value[end] > line.value[most]) most = end;
    }
    std::size_t drawn = end;
    for (const std::size_t k : {i, std::min(least, most), std::max(least, most), end - 1}) {
      if (k == drawn) continue;
      to(x(line.time_s[k]), line.value[k]);
      drawn = k;
    }
    i = end;
  }
  return path;
}

}  // namespace

double nice_step(double span, int most) {
  const double least = span / most, power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double step : {1.0, 2.0, 5.0})
    if (step * power >= least * (1.0 - 1e-9)) return step * power;
  return 10.0 * power;
}

std::string time_plot_svg(const TimePlot& plot) {
  double low = plot.from_zero ? 0.0 : std::numeric_limits<double>::infinity(),
         high = -std::numeric_limits<double>::infinity();
  for (const TimeSeries& line : plot.lines)
    for (const double value : line.value)
      if (!std::isnan(value)) low = std::min(low, value), high = std::max(high, value);
  if (!std::isfinite(low) || !std::isfinite(high)) low = 0.0, high = 1.0;
  if (high - low < 1e-6) low -= plot.from_zero ? 0.0 : 0.5, high += 0.5;
  const double step = nice_step(high - low, 5);
  low = std::floor(low / step + 1e-9) * step, high = std::ceil(high / step - 1e-9) * step;
  const double to_s = std::max(plot.to_s, plot.from_s + 1e-3);
  const Scale x{plot.from_s, to_s, kLeft, kWidth - kRight}, y{low, high, kHeight - kBottom, kTop};

  std::string svg = fmt::format("<svg class=\"plot\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">", kWidth,
                                kHeight, escaped(plot.title));
  // What shone: high beam and darkness shade the background.
  for (const DriveSeries::Lit& band : plot.bands) {
    const bool dark = band.lit.empty(), bright = band.lit.find("high") != std::string::npos;
    if (!dark && !bright) continue;
    svg +=
        fmt::format("<rect class=\"{}\" x=\"{:.1f}\" y=\"{}\" width=\"{:.1f}\" height=\"{}\"><title>{}</title></rect>",
                    dark ? "dark" : "high", x(band.from_s), kTop, x(band.to_s) - x(band.from_s),
                    kHeight - kBottom - kTop, escaped(dark ? "dark" : band.lit + ", " + band.design));
  }
  for (double value = low; value <= high + 1e-9 * step; value += step)
    svg += fmt::format(
        "<path class=\"grid\" d=\"M{:.1f} {:.1f}H{:.1f}\"/><text x=\"{:.1f}\" y=\"{:.1f}\" "
        "text-anchor=\"end\">{:g}</text>",
        kLeft, y(value), kWidth - kRight, kLeft - 6, y(value) + 4, std::abs(value) < 1e-9 ? 0.0 : value);
  const double step_s = nice_step(to_s - plot.from_s, 10);
  for (double at_s = std::ceil(plot.from_s / step_s - 1e-9) * step_s; at_s <= to_s + 1e-9; at_s += step_s)
    svg += fmt::format(
        "<path class=\"grid\" d=\"M{:.1f} {}V{}\"/><text x=\"{:.1f}\" y=\"{}\" "
        "text-anchor=\"middle\">{:g}</text>",
        x(at_s), kTop, kHeight - kBottom, x(at_s), kHeight - kBottom + 15, std::abs(at_s) < 1e-9 ? 0.0 : at_s);
  svg += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"end\">s</text>", kWidth - kRight, kHeight - 4);
  svg += fmt::format("<text class=\"name\" x=\"{}\" y=\"16\">{}</text>", kLeft, escaped(plot.title + ", " + plot.unit));
  double name_px = kWidth - kRight;
  for (std::size_t i = std::min(plot.lines.size(), kInks.size()); i-- > 0;) {
    const std::string name = escaped(plot.lines[i].name);
    if (const std::string path = path_of(plot.lines[i], x, y); !path.empty())
      svg += fmt::format("<path class=\"line\" stroke=\"{}\" d=\"{}\"/>", kInks[i], path);
    if (plot.lines.size() < 2) continue;
    svg += fmt::format("<text x=\"{:.0f}\" y=\"16\" text-anchor=\"end\" style=\"fill:{}\">{}</text>", name_px, kInks[i],
                       name);
    name_px -= 14.0 + 6.3 * static_cast<double>(name.size());
  }
  return svg + "</svg>";
}

}  // namespace phare
