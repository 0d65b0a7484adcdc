#include "vehicle_dynamics/plot_page.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace phare::batch {
namespace {

constexpr const char* kPageStyle = R"(
:root{--bg:#fff;--ink:#1b2430;--dim:#66717f;--grid:#e3e7ec;--line:#c6cdd6;--c0:#1f5fbf;--c1:#c2410c;--c2:#15803d;--c3:#8b2fb8;--ref:#111}
@media(prefers-color-scheme:dark){:root{--bg:#0b0e13;--ink:#e6eaf0;--dim:#8e9aab;--grid:#1d2530;--line:#334052;--c0:#7ab0ff;--c1:#ffb26b;--c2:#7fd89a;--c3:#d7a1f5;--ref:#fff}}
*{box-sizing:border-box}body{margin:0 auto;max-width:1240px;padding:24px;background:var(--bg);color:var(--ink);font:15px/1.5 system-ui,-apple-system,"Segoe UI",Roboto,sans-serif}
h1{font-size:26px;margin:0 0 6px}h2{font-size:15px;margin:26px 0 8px}p{margin:4px 0;color:var(--dim)}
table{border-collapse:collapse;font-size:14px}td,th{padding:3px 18px 3px 0;text-align:right;font-variant-numeric:tabular-nums}th{color:var(--dim);font-weight:500}td:first-child,th:first-child{text-align:left}
.panels{display:grid;grid-template-columns:repeat(auto-fit,minmax(520px,1fr));gap:8px 24px;margin-top:20px}figure{margin:0;break-inside:avoid}
svg{display:block;width:100%;height:auto;font:12px system-ui,-apple-system,"Segoe UI",Roboto,sans-serif}
@media print{body{max-width:none;padding:0}}
)";
constexpr double kWide = 560.0, kHigh = 230.0, kLeft = 58.0, kRight = 12.0, kTop = 40.0, kBottom = 30.0;

std::string escaped_text(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  return out;
}

std::string shown(double value, const char* format = "%.4g") {
  char text[40];
  std::snprintf(text, sizeof text, format, value == 0.0 ? 0.0 : value);
  return text;
}

// Round numbers, four to eight of them over a span.
double tick_step(double span) {
  const double raw = span / 5.0, ten = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double nice : {1.0, 2.0, 2.5, 5.0})
    if (raw <= nice * ten) return nice * ten;
  return 10.0 * ten;
}

// An axis from data to picture; it begins and ends a little beyond the data.
struct Axis {
  double from = 0.0, to = 1.0, pixel_from = 0.0, pixel_to = 1.0, step = 0.2;

  static Axis over(double low, double high, double pixel_from, double pixel_to, bool tight) {
    if (!(low <= high)) low = 0.0, high = 1.0;
    const double size = std::max({std::abs(low), std::abs(high), 1e-9});
    if (high - low < 1e-6 * size) {  // constant
      const double room = size > 1e-6 ? 0.5 * size : 1.0;
      low -= room, high += room;
    }
    const double room = tight ? 0.0 : 0.06 * (high - low);
    return {low - room, high + room, pixel_from, pixel_to, tick_step(high - low + 2.0 * room)};
  }
  double operator()(double value) const { return pixel_from + (value - from) / (to - from) * (pixel_to - pixel_from); }
  std::vector<double> ticks() const {
    std::vector<double> out;
    for (double at = std::ceil(from / step); at * step <= to + 1e-9 * step; at += 1.0) out.push_back(at * step);
    return out;
  }
};

class Svg {
 public:
  Svg(double wide, double high) {
    text_ = "<svg viewBox=\"0 0 " + shown(wide) + " " + shown(high) + "\" role=\"img\">";
  }
  void line(double x1, double y1, double x2, double y2, const char* style) {
    text_ += "<line x1=\"" + at(x1) + "\" y1=\"" + at(y1) + "\" x2=\"" + at(x2) + "\" y2=\"" + at(y2) + "\" style=\"" +
             style + "\"/>";
  }
  void label(double x, double y, const std::string& words, const char* anchor, const char* style) {
    text_ += "<text x=\"" + at(x) + "\" y=\"" + at(y) + "\" text-anchor=\"" + anchor + "\" style=\"" + style + "\">" +
             escaped_text(words) + "</text>";
  }
  void begin_path() { points_.clear(); }
  void to(double x, double y) { points_ += at(x) + "," + at(y) + " "; }
  void end_path(const std::string& style) {
    text_ += "<polyline points=\"" + points_ + "\" style=\"fill:none;stroke-linejoin:round;" + style + "\"/>";
  }
  std::string take() { return text_ + "</svg>"; }

 private:
  static std::string at(double value) { return shown(value, "%.1f"); }
  std::string text_, points_;
};

void frame(Svg& svg, const Axis& x, const Axis& y, const std::string& title, const std::string& under) {
  for (const double tick : x.ticks()) {
    svg.line(x(tick), y.pixel_from, x(tick), y.pixel_to, "stroke:var(--grid)");
    svg.label(x(tick), y.pixel_from + 15.0, shown(tick), "middle", "fill:var(--dim)");
  }
  for (const double tick : y.ticks()) {
    const bool zero = std::abs(tick) < 1e-9 * y.step;
    svg.line(x.pixel_from, y(tick), x.pixel_to, y(tick), zero ? "stroke:var(--line)" : "stroke:var(--grid)");
    svg.label(x.pixel_from - 6.0, y(tick) + 4.0, shown(zero ? 0.0 : tick), "end", "fill:var(--dim)");
  }
  svg.label(x.pixel_from, 14.0, title, "start", "fill:var(--ink);font-weight:600");
  svg.label(x.pixel_to, y.pixel_from + 28.0, under, "end", "fill:var(--dim)");
}

// Lines of a legend behind one another, from the left.
class Legend {
 public:
  Legend(Svg& svg, double x) : svg_(svg), x_(x) {}
  void add(const std::string& words, const std::string& style) {
    svg_.line(x_, 26.0, x_ + 18.0, 26.0, style.c_str());
    svg_.label(x_ + 22.0, 30.0, words, "start", "fill:var(--dim)");
    x_ += 36.0 + 6.4 * static_cast<double>(words.size());
  }

 private:
  Svg& svg_;
  double x_;
};

std::string line_style(std::size_t index) {
  return "stroke:var(--c" + std::to_string(index % 4) + ");stroke-width:1.4";
}
const std::string kReferenceStyle = "stroke:var(--ref);stroke-width:1;stroke-dasharray:4 3";

const std::vector<double>* reference_of(const Traces& traces, const char* column) {
  if (!traces.reference()) return nullptr;
  const auto found = traces.reference()->columns.find(column);
  return found == traces.reference()->columns.end() ? nullptr : &found->second;
}

// Lamps that nothing levels are no trace.
bool idle(const Panel& panel, const Traces& traces) {
  const Quantity& line = panel.lines.front();
  return std::string(line.column) == "lamp_tilt_rad" &&
         std::all_of(traces.pieces().begin(), traces.pieces().end(), [&](const Traces::Piece& piece) {
           return piece.least[line.at] == 0.0f && piece.largest[line.at] == 0.0f;
         });
}

std::string panel_svg(const Panel& panel, const Traces& traces, const PageWords& words) {
  const auto& pieces = traces.pieces();
  const double begin = pieces.front().from_s, end = pieces.back().to_s;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  const auto seen = [&](double value) {
    low = std::min(low, value * panel.scale), high = std::max(high, value * panel.scale);
  };
  for (const Quantity& line : panel.lines) {
    for (const auto& piece : pieces) seen(piece.least[line.at]), seen(piece.largest[line.at]);
    if (const auto* theirs = reference_of(traces, line.column))
      for (std::size_t i = 0; i < theirs->size(); ++i)
        if (traces.reference()->time_s[i] >= begin && traces.reference()->time_s[i] <= end) seen((*theirs)[i]);
  }
  const Axis x = Axis::over(begin, end, kLeft, kWide - kRight, true),
             y = Axis::over(low, high, kHigh - kBottom, kTop, false);
  Svg svg(kWide, kHigh);
  frame(svg, x, y, std::string(panel.title) + (panel.unit[0] ? std::string(", ") + panel.unit : ""), "s");
  for (const LevelSwitch& change : words.switched)
    svg.line(x(begin + change.time_s), y.pixel_from, x(begin + change.time_s), y.pixel_to,
             "stroke:var(--dim);stroke-dasharray:1 3");
  Legend legend(svg, kLeft);
  bool referred = false;
  for (std::size_t i = 0; i < panel.lines.size(); ++i) {
    const Quantity& line = panel.lines[i];
    svg.begin_path();
    for (const auto& piece : pieces) {
      svg.to(x(piece.from_s), y(piece.least[line.at] * panel.scale));
      if (piece.largest[line.at] != piece.least[line.at])
        svg.to(x(piece.to_s), y(piece.largest[line.at] * panel.scale));
    }
    svg.end_path(line_style(i));
    if (panel.lines.size() > 1) legend.add(line.legend, line_style(i));
    const auto* theirs = reference_of(traces, line.column);
    if (!theirs) continue;
    const auto& times = traces.reference()->time_s;
    const std::size_t each = std::max<std::size_t>(1, times.size() / 4000);
    svg.begin_path();
    for (std::size_t n = 0; n < times.size(); n += each)
      if (times[n] >= begin && times[n] <= end) svg.to(x(times[n]), y((*theirs)[n] * panel.scale));
    svg.end_path(kReferenceStyle);
    referred = true;
  }
  if (referred) legend.add("reference", kReferenceStyle);
  return svg.take();
}

// From above, as far right as it is far up.
std::string path_svg(const Traces& traces) {
  constexpr std::size_t kX = offsetof(Row, x_m) / sizeof(double), kY = offsetof(Row, y_m) / sizeof(double);
  double box[4] = {1e300, -1e300, 1e300, -1e300};
  const auto seen = [&](double x, double y) {
    box[0] = std::min(box[0], x), box[1] = std::max(box[1], x), box[2] = std::min(box[2], y),
    box[3] = std::max(box[3], y);
  };
  for (const auto& piece : traces.pieces())
    seen(piece.least[kX], piece.least[kY]), seen(piece.largest[kX], piece.largest[kY]);
  const double wide = kWide - kRight - kLeft, tall = kHigh - kBottom - kTop;
  const double per_pixel = std::max({(box[1] - box[0]) / wide, (box[3] - box[2]) / tall, 1e-3}) * 1.06;
  const double mid_x = 0.5 * (box[0] + box[1]), mid_y = 0.5 * (box[2] + box[3]);
  const Axis x =
      Axis::over(mid_x - 0.5 * wide * per_pixel, mid_x + 0.5 * wide * per_pixel, kLeft, kWide - kRight, true);
  const Axis y =
      Axis::over(mid_y - 0.5 * tall * per_pixel, mid_y + 0.5 * tall * per_pixel, kHigh - kBottom, kTop, true);
  Svg svg(kWide, kHigh);
  frame(svg, x, y, "Path of the centre of gravity from above, m", "x, m");
  svg.begin_path();
  for (const auto& piece : traces.pieces())
    svg.to(x(0.5 * (piece.least[kX] + piece.largest[kX])), y(0.5 * (piece.least[kY] + piece.largest[kY])));
  svg.end_path(line_style(0));
  const auto *their_x = reference_of(traces, "x_m"), *their_y = reference_of(traces, "y_m");
  if (their_x && their_y) {
    svg.begin_path();
    const std::size_t each = std::max<std::size_t>(1, their_x->size() / 4000);
    for (std::size_t n = 0; n < their_x->size(); n += each) {
      const double px = x((*their_x)[n]), py = y((*their_y)[n]);
      if (px >= x.pixel_from && px <= x.pixel_to && py >= y.pixel_to && py <= y.pixel_from) svg.to(px, py);
    }
    svg.end_path(kReferenceStyle);
    Legend(svg, kLeft).add("reference", kReferenceStyle);
  }
  return svg.take();
}

std::string difference_table(const Traces& traces) {
  std::string rows;
  for (const Panel& panel : panels())
    for (const Quantity& line : panel.lines) {
      const Difference* d = traces.shows(panel) ? traces.difference(line) : nullptr;
      if (!d || (d->peak == 0.0 && d->largest == 0.0)) continue;
      const double rms = std::sqrt(d->sum_of_squares / static_cast<double>(d->count));
      rows += "<tr><td>" + escaped_text(panel.title) + (panel.lines.size() > 1 ? std::string(": ") + line.legend : "") +
              "</td><td>" + shown(d->largest * panel.scale, "%.3g") + " " + panel.unit + "</td><td>" +
              shown(d->at_s, "%.2f") + " s</td><td>" +
              (d->peak > 0.0 ? shown(100.0 * d->largest / d->peak, "%.2f") + " %" : "–") + "</td><td>" +
              shown(rms * panel.scale, "%.3g") + " " + panel.unit + "</td></tr>";
    }
  if (rows.empty()) return {};
  return "<h2>Against " + escaped_text(traces.reference()->name) +
         "</h2><table><tr><th></th><th>largest difference</th><th>at</th><th>of the reference's "
         "peak</th><th>rms</th></tr>" +
         rows + "</table>";
}

}  // namespace

std::string plot_page(const PageWords& words, const Traces& traces) {
  std::string page =
      "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\"><title>" +
      escaped_text(words.title) + "</title><style>" + kPageStyle + "</style></head><body><h1>" +
      escaped_text(words.title) + "</h1>";
  page += "<table>";
  for (const auto& [what, value] : words.facts)
    page +=
        "<tr><th>" + escaped_text(what) + "</th><td style=\"text-align:left\">" + escaped_text(value) + "</td></tr>";
  page += "</table>";
  if (!words.figures.empty()) {
    page += "<h2>Figures</h2><table>";
    for (const std::string& figure : words.figures) page += "<tr><td>" + escaped_text(figure) + "</td></tr>";
    page += "</table>";
  }
  if (traces.reference()) page += difference_table(traces);
  if (!words.switched.empty()) {
    page += "<h2>Level auto</h2><table>";
    for (const LevelSwitch& change : words.switched)
      page += "<tr><td>" + shown(change.time_s, "%.3f") + " s</td><td style=\"text-align:left\">" +
              escaped_text(text(change)) + "</td></tr>";
    page += "</table>";
  }
  page += "<div class=\"panels\">";
  if (!traces.pieces().empty()) {
    for (const Panel& panel : panels())
      if (traces.shows(panel) && !idle(panel, traces))
        page += "<figure>" + panel_svg(panel, traces, words) + "</figure>";
    page += "<figure>" + path_svg(traces) + "</figure>";
  }
  return page + "</div></body></html>\n";
}

}  // namespace phare::batch
