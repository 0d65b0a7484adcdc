#include "tools/lamp/chart.h"

#include <cairo-svg.h>
#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <utility>

#include "config/base/whole_file.h"

namespace phare {
namespace {

constexpr const char* kFont = "DejaVu Sans";

void set_colour(cairo_t* cairo, Rgb c, double alpha = 1.0) {
  cairo_set_source_rgba(cairo, c.r, c.g, c.b, alpha);
}

std::string xml_text(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else if (c == '>') {
      result += "&gt;";
    } else {
      result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return result;
}

std::string svg_colour(Rgb c) {
  char text[32];
  std::snprintf(text, sizeof text, "rgb(%ld,%ld,%ld)", std::lround(255 * c.r), std::lround(255 * c.g),
                std::lround(255 * c.b));
  return text;
}

Rgb rim_of(Rgb colour) {
  return 0.2126 * colour.r + 0.7152 * colour.g + 0.0722 * colour.b > 0.75 ? kBlack : kWhite;
}

void select_font(cairo_t* cairo, double size, bool bold) {
  cairo_select_font_face(cairo, kFont, CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo, size);
}

constexpr double kBaseline = 0.36;  ///< of the size below the middle of a text
constexpr double kHalo = 2.5, kHaloAlpha = 0.75;

void draw_text(cairo_t* cairo, const ChartText& t) {
  select_font(cairo, t.size, t.bold);
  cairo_text_extents_t box;
  cairo_text_extents(cairo, t.text.c_str(), &box);
  const double left = -box.x_bearing - (t.align < 0 ? 0.0 : t.align == 0 ? 0.5 * box.width : box.width);
  cairo_save(cairo);
  cairo_translate(cairo, t.x, t.y);
  cairo_rotate(cairo, t.turned_deg * M_PI / 180.0);
  if (t.halo) {
    cairo_move_to(cairo, left, kBaseline * t.size);
    cairo_text_path(cairo, t.text.c_str());
    set_colour(cairo, rim_of(t.colour), kHaloAlpha);
    cairo_set_line_width(cairo, kHalo);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke(cairo);
  }
  cairo_move_to(cairo, left, kBaseline * t.size);
  set_colour(cairo, t.colour);
  cairo_show_text(cairo, t.text.c_str());
  cairo_restore(cairo);
}

std::string svg_text(const ChartText& t) {
  char text[240];
  std::snprintf(text, sizeof text, "<text x=\"%.2f\" y=\"%.2f\" font-size=\"%g\" text-anchor=\"%s\" fill=\"%s\"", t.x,
                t.y + kBaseline * t.size, t.size,
                t.align < 0    ? "start"
                : t.align == 0 ? "middle"
                               : "end",
                svg_colour(t.colour).c_str());
  std::string element = text;
  if (t.bold) element += " font-weight=\"bold\"";
  if (t.halo) {
    std::snprintf(
        text, sizeof text,
        " paint-order=\"stroke\" stroke=\"%s\" stroke-opacity=\"%g\" stroke-width=\"%g\" stroke-linejoin=\"round\"",
        svg_colour(rim_of(t.colour)).c_str(), kHaloAlpha, kHalo);
    element += text;
  }
  if (t.turned_deg != 0.0) {
    std::snprintf(text, sizeof text, " transform=\"rotate(%g %.2f %.2f)\"", t.turned_deg, t.x, t.y);
    element += text;
  }
  return element + ">" + xml_text(t.text) + "</text>\n";
}

cairo_status_t append(void* to, const unsigned char* data, unsigned int count) {
  static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(data), count);
  return CAIRO_STATUS_SUCCESS;
}

std::string tick_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", std::abs(value) < 1e-9 ? 0.0 : value);
  return text;
}

}  // namespace

Rgb chart_colour(double t) {
  constexpr std::array<Rgb, 8> kStops{{{0, 0, 0},
                                       {0.05, 0.05, 0.40},
                                       {0.35, 0.05, 0.62},
                                       {0.72, 0.10, 0.45},
                                       {0.93, 0.30, 0.15},
                                       {0.99, 0.62, 0.08},
                                       {0.99, 0.92, 0.35},
                                       {1, 1, 1}}};
  t = std::clamp(t, 0.0, 1.0) * static_cast<double>(kStops.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(t), kStops.size() - 2);
  const double u = t - static_cast<double>(i);
  const Rgb a = kStops[i], b = kStops[i + 1];
  return {a.r + u * (b.r - a.r), a.g + u * (b.g - a.g), a.b + u * (b.b - a.b)};
}

void Chart::rectangle(double x, double y, double w, double h, Rgb fill) {
  cairo_rectangle(cairo_, x, y, w, h);
  set_colour(cairo_, fill);
  cairo_fill(cairo_);
}

void Chart::line(const std::vector<std::array<double, 2>>& points, Rgb colour, double width, bool closed, bool dashed) {
  if (points.empty()) return;
  cairo_new_path(cairo_);
  for (const auto& p : points) cairo_line_to(cairo_, p[0], p[1]);
  if (closed) cairo_close_path(cairo_);
  const double dash[] = {4.0, 3.0};
  cairo_set_dash(cairo_, dash, dashed ? 2 : 0, 0.0);
  cairo_set_line_width(cairo_, width);
  cairo_set_line_join(cairo_, CAIRO_LINE_JOIN_ROUND);
  set_colour(cairo_, colour);
  cairo_stroke(cairo_);
  cairo_set_dash(cairo_, nullptr, 0, 0.0);
}

void Chart::circle(double x, double y, double radius, Rgb colour, double width, bool filled) {
  cairo_new_path(cairo_);
  cairo_arc(cairo_, x, y, radius, 0.0, 2.0 * M_PI);
  set_colour(cairo_, colour);
  cairo_set_line_width(cairo_, width);
  if (filled) {
    cairo_fill(cairo_);
  } else {
    cairo_stroke(cairo_);
  }
}

void Chart::text(double x, double y, const std::string& text, double size, int align, Rgb colour, bool bold,
                 bool halo) {
  texts_.push_back({x, y, size, align, colour, bold, halo, 0.0, printable(text)});
}

double Chart::width_of(const std::string& text, double size, bool bold) const {
  select_font(cairo_, size, bold);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo_, printable(text).c_str(), &extents);
  return extents.width;
}

void Chart::vertical_text(double x, double y, const std::string& text, double size, Rgb colour) {
  texts_.push_back({x, y, size, 0, colour, false, false, -90.0, printable(text)});
}

void Chart::keep_free(double left, double top, double width, double height) {
  taken_.push_back({left, top, left + width, top + height});
}

bool Chart::label(const std::vector<LabelPlace>& places, const std::string& what, double size, Rgb colour, bool bold,
                  bool halo) {
  const double width = width_of(what, size, bold);
  for (const LabelPlace& place : places) {
    const double left = place.x - (place.align < 0 ? 0.0 : place.align == 0 ? 0.5 : 1.0) * width;
    const Box box{left - 1.0, place.y - 0.5 * size, left + width + 1.0, place.y + 0.5 * size};
    if (clip_ && (box.left < clip_->left || box.right > clip_->left + clip_->width || box.top < clip_->top ||
                  box.bottom > clip_->top + clip_->height))
      continue;
    const bool free = std::none_of(taken_.begin(), taken_.end(), [&](const Box& other) {
      return box.left < other.right && other.left < box.right && box.top < other.bottom && other.top < box.bottom;
    });
    if (!free) continue;
    taken_.push_back(box);
    text(place.x, place.y, what, size, place.align, colour, bold, halo);
    return true;
  }
  return false;
}

void Chart::picture(const Axes& axes, std::size_t columns, std::size_t rows,
                    const std::function<Rgb(std::size_t, std::size_t)>& pixel) {
  cairo_surface_t* image =
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(columns), static_cast<int>(rows));
  unsigned char* data = cairo_image_surface_get_data(image);
  const int stride = cairo_image_surface_get_stride(image);
  for (std::size_t j = 0; j < rows; ++j) {
    for (std::size_t i = 0; i < columns; ++i) {
      const Rgb c = pixel(i, j);
      unsigned char* p = data + j * static_cast<std::size_t>(stride) + 4 * i;
      p[0] = static_cast<unsigned char>(std::lround(255.0 * c.b));  // little endian: B, G, R
      p[1] = static_cast<unsigned char>(std::lround(255.0 * c.g));
      p[2] = static_cast<unsigned char>(std::lround(255.0 * c.r));
    }
  }
  cairo_surface_mark_dirty(image);
  cairo_save(cairo_);
  cairo_translate(cairo_, axes.left, axes.top);
  cairo_scale(cairo_, axes.width / static_cast<double>(columns), axes.height / static_cast<double>(rows));
  cairo_set_source_surface(cairo_, image, 0.0, 0.0);
  cairo_pattern_set_extend(cairo_get_source(cairo_), CAIRO_EXTEND_PAD);  // no soft rim
  cairo_rectangle(cairo_, 0.0, 0.0, static_cast<double>(columns), static_cast<double>(rows));
  cairo_fill(cairo_);
  cairo_restore(cairo_);
  cairo_surface_destroy(image);
}

void Chart::axes(const Axes& a, double x_step, double y_step, const std::string& x_title, const std::string& y_title,
                 Rgb grid, double grid_width) {
  const double bottom = a.top + a.height, right = a.left + a.width;
  if (x_step > 0.0) {
    const double low = std::min(a.x_min, a.x_max), high = std::max(a.x_min, a.x_max);
    for (double v = std::ceil(low / x_step - 1e-9) * x_step; v <= high + 1e-9; v += x_step) {
      if (grid_width > 0.0) line({{a.x(v), a.top}, {a.x(v), bottom}}, grid, grid_width);
      line({{a.x(v), bottom}, {a.x(v), bottom + 4}}, kBlack, 0.8);
      text(a.x(v), bottom + 12, tick_text(v), 9, 0, kBlack);
    }
  }
  if (y_step > 0.0) {
    for (double v = std::ceil(a.y_min / y_step - 1e-9) * y_step; v <= a.y_max + 1e-9; v += y_step) {
      if (grid_width > 0.0) line({{a.left, a.y(v)}, {right, a.y(v)}}, grid, grid_width);
      line({{a.left - 4, a.y(v)}, {a.left, a.y(v)}}, kBlack, 0.8);
      text(a.left - 7, a.y(v), tick_text(v), 9, 1, kBlack);
    }
  }
  line({{a.left, a.top}, {right, a.top}, {right, bottom}, {a.left, bottom}}, kBlack, 1.0, true);
  text(0.5 * (a.left + right), bottom + 27, x_title, 10, 0, kBlack);
  vertical_text(a.left - 38, a.top + 0.5 * a.height, y_title, 10, kBlack);
}

void Chart::begin_clip(const Axes& a) {
  clip_ = a;
  cairo_save(cairo_);
  cairo_rectangle(cairo_, a.left, a.top, a.width, a.height);
  cairo_clip(cairo_);
}

void Chart::end_clip() {
  clip_.reset();
  cairo_restore(cairo_);
}

std::vector<Contour> contours(const std::vector<double>& values, const std::vector<double>& x,
                              const std::vector<double>& y, double level) {
  // Marching squares. A crossing belongs to a grid edge, which is its name: equal names join segments to lines.
  const std::size_t columns = x.size(), rows = y.size();
  using Edge = std::size_t;  // 2·node + (0: to the right, 1: upwards)
  std::map<Edge, std::array<double, 2>> place;
  std::multimap<Edge, Edge> joined;
  const auto crossing = [&](std::size_t i, std::size_t j, bool up) {
    const std::size_t a = j * columns + i, b = up ? a + columns : a + 1;
    const double t = (level - values[a]) / (values[b] - values[a]);
    const Edge edge = 2 * a + (up ? 1 : 0);
    place[edge] = up ? std::array<double, 2>{x[i], y[j] + t * (y[j + 1] - y[j])}
                     : std::array<double, 2>{x[i] + t * (x[i + 1] - x[i]), y[j]};
    return edge;
  };
  for (std::size_t j = 0; j + 1 < rows; ++j) {
    for (std::size_t i = 0; i + 1 < columns; ++i) {
      // Beside places without data there is no line.
      const std::size_t at = j * columns + i;
      if (std::isnan(values[at] + values[at + 1] + values[at + columns] + values[at + columns + 1])) continue;
      const auto above = [&](std::size_t di, std::size_t dj) { return values[(j + dj) * columns + i + di] >= level; };
      const bool a = above(0, 0), b = above(1, 0), c = above(1, 1), d = above(0, 1);
      std::vector<Edge> cut;
      if (a != b) cut.push_back(crossing(i, j, false));
      if (b != c) cut.push_back(crossing(i + 1, j, true));
      if (c != d) cut.push_back(crossing(i, j + 1, false));
      if (d != a) cut.push_back(crossing(i, j, true));
      for (std::size_t k = 0; k + 1 < cut.size(); k += 2) {
        joined.emplace(cut[k], cut[k + 1]);
        joined.emplace(cut[k + 1], cut[k]);
      }
    }
  }
  std::vector<Contour> lines;
  const auto follow = [&](Edge at) {
    Contour line;
    while (true) {
      line.points.push_back(place[at]);
      const auto next = joined.find(at);
      if (next == joined.end()) return line;
      const Edge to = next->second;
      joined.erase(next);
      const auto range = joined.equal_range(to);
      for (auto it = range.first; it != range.second; ++it) {
        if (it->second == at) {
          joined.erase(it);
          break;
        }
      }
      at = to;
    }
  };
  // Open lines from their ends first, then the rings.
  for (const auto& [edge, where] : place) {
    if (joined.count(edge) == 1) lines.push_back(follow(edge));
  }
  while (!joined.empty()) lines.push_back(follow(joined.begin()->first));
  return lines;
}

void draw_contours(Chart& chart, const Axes& axes, const std::vector<Contour>& lines, Rgb colour, double width,
                   const std::string& label, std::vector<PendingLabel>& labels) {
  constexpr double kWorthAName = 45.0;
  double longest = 0.0;
  std::vector<LabelPlace> places;
  for (const Contour& contour : lines) {
    std::vector<std::array<double, 2>> points;
    double length = 0.0;
    for (const auto& p : contour.points) {
      points.push_back({axes.x(p[0]), axes.y(p[1])});
      const auto n = points.size();
      if (n > 1) length += std::hypot(points[n - 1][0] - points[n - 2][0], points[n - 1][1] - points[n - 2][1]);
    }
    chart.line(points, colour, width);
    if (length <= std::max(longest, kWorthAName)) continue;
    longest = length;
    places.clear();
    for (const double at : {0.33, 0.2, 0.45, 0.1, 0.6, 0.7, 0.8, 0.27, 0.52, 0.15, 0.9}) {
      const auto& p =
          points[std::min(points.size() - 1, static_cast<std::size_t>(at * static_cast<double>(points.size())))];
      places.push_back({p[0], p[1], 0});
    }
  }
  if (!places.empty() && !label.empty()) labels.push_back({label, colour, std::move(places)});
}

void draw_labels(Chart& chart, const std::vector<PendingLabel>& labels) {
  for (const PendingLabel& label : labels) chart.label(label.places, label.text, 8, label.colour);
}

std::string printable(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const unsigned char lead = static_cast<unsigned char>(text[i]);
    const std::size_t length = lead < 0x80                   ? 1
                               : lead >= 0xC2 && lead < 0xE0 ? 2
                               : lead >= 0xE0 && lead < 0xF0 ? 3
                               : lead >= 0xF0 && lead < 0xF5 ? 4
                                                             : 0;
    bool whole = length > 0 && i + length <= text.size();
    for (std::size_t k = 1; whole && k < length; ++k) whole = (static_cast<unsigned char>(text[i + k]) & 0xC0) == 0x80;
    if (whole && length >= 3) {  // neither longer than need be, nor a surrogate, nor beyond the last character
      const unsigned char second = static_cast<unsigned char>(text[i + 1]);
      whole = !(lead == 0xE0 && second < 0xA0) && !(lead == 0xED && second >= 0xA0) &&
              !(lead == 0xF0 && second < 0x90) && !(lead == 0xF4 && second >= 0x90);
    }
    if (whole) {
      result += text.substr(i, length);
      i += length;
    } else {
      result += '?';
      ++i;
    }
  }
  return result;
}

Status write_chart(const std::string& stem, double width, double height, const std::function<void(Chart&)>& draw) {
  // Drawn into each file by itself: cairo 1.16 does not give back a recording that was played into an SVG.
  std::vector<ChartText> all_texts;
  const auto draw_on = [&](cairo_surface_t* surface, double scale, bool with_texts) {
    cairo_t* const cairo = cairo_create(surface);
    cairo_scale(cairo, scale, scale);
    Chart chart(cairo);
    chart.rectangle(0, 0, width, height, kWhite);
    draw(chart);
    all_texts = chart.texts();
    if (with_texts) {
      for (const ChartText& text : all_texts) draw_text(cairo, text);
    }
    const cairo_status_t drawn = cairo_status(cairo);
    cairo_destroy(cairo);
    return drawn;
  };
  const auto failed = [](const std::string& file, cairo_status_t cause) {
    return Error{file, std::string("cannot be drawn: ") + cairo_status_to_string(cause)};
  };

  std::string svg_bytes, png_bytes;
  constexpr double kPixelsPerPoint = 2.0;
  cairo_surface_t* const png = cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(width * kPixelsPerPoint),
                                                          static_cast<int>(height * kPixelsPerPoint));
  cairo_status_t status = draw_on(png, kPixelsPerPoint, true);
  if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_write_to_png_stream(png, append, &png_bytes);
  cairo_surface_destroy(png);

  cairo_surface_t* const svg = cairo_svg_surface_create_for_stream(append, &svg_bytes, width, height);
  if (status == CAIRO_STATUS_SUCCESS) status = draw_on(svg, 1.0, false);
  cairo_surface_finish(svg);
  if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(svg);
  cairo_surface_destroy(svg);
  if (status != CAIRO_STATUS_SUCCESS) return failed(stem, status);

  std::string texts = std::string("<g font-family=\"") + kFont + ", Verdana, sans-serif\">\n";
  for (const ChartText& text : all_texts) texts += svg_text(text);
  svg_bytes.insert(std::min(svg_bytes.rfind("</svg>"), svg_bytes.size()), texts + "</g>\n");
  if (const Status written = write_whole_file(stem + ".svg", svg_bytes); !written) return written.error();
  return write_whole_file(stem + ".png", png_bytes);
}

}  // namespace phare
