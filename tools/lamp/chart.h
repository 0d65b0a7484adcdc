// Charts of the lamp bench: one drawing, written as SVG and as PNG. By cairo; coordinates in points, y down.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "config/base/result.h"

typedef struct _cairo cairo_t;

namespace phare {

struct Rgb {
  double r = 0.0, g = 0.0, b = 0.0;
};

inline constexpr Rgb kBlack{0, 0, 0}, kWhite{1, 1, 1}, kGrey{0.55, 0.55, 0.55}, kPass{0.0, 0.62, 0.25},
    kFailed{0.85, 0.05, 0.05}, kWithin{0.9, 0.6, 0.0};

/// False colour of t in 0..1: black, blue, violet, red, orange, yellow, white.
Rgb chart_colour(double t_01);

/// A rectangle of the page with two linear axes.
struct Axes {
  double left = 0, top = 0, width = 0, height = 0;    ///< on the page
  double x_min = 0, x_max = 1, y_min = 0, y_max = 1;  ///< y_max is at the top
  double x(double value) const { return left + (value - x_min) / (x_max - x_min) * width; }
  double y(double value) const { return top + (y_max - value) / (y_max - y_min) * height; }
};

/// Where a label may stand: left (-1), middle (0) or right (1) of the point, at its height.
struct LabelPlace {
  double x = 0, y = 0;
  int align = 0;
};

/// A text of a chart. Kept apart from the drawing: SVG has it as text, and it stands above everything.
struct ChartText {
  double x = 0, y = 0, size = 10;
  int align = -1;
  Rgb colour;
  bool bold = false, halo = false;
  double turned_deg = 0.0;
  std::string text;
};

class Chart {
 public:
  explicit Chart(cairo_t* cairo) : cairo_(cairo) {}

  void rectangle(double x, double y, double w, double h, Rgb fill);
  void line(const std::vector<std::array<double, 2>>& points, Rgb colour, double width, bool closed = false,
            bool dashed = false);
  void circle(double x, double y, double radius, Rgb colour, double width, bool filled = false);
  /// align: -1 left, 0 middle, 1 right of the point, at its height. `halo`: a rim that stands out from pictures.
  void text(double x, double y, const std::string& text, double size, int align, Rgb colour, bool bold = false,
            bool halo = false);
  /// How wide a text is drawn.
  double width_of(const std::string& text, double size, bool bold = false) const;
  /// A text at the first of the places where it is inside the clip and on no other label. False: nowhere.
  bool label(const std::vector<LabelPlace>& places, const std::string& text, double size, Rgb colour, bool bold = true,
             bool halo = true);
  /// Labels keep off this box.
  void keep_free(double left, double top, double width, double height);
  void vertical_text(double x, double y, const std::string& text, double size, Rgb colour);
  /// A picture of columns × rows pixels over the axes' rectangle, first row at the top.
  void picture(const Axes& axes, std::size_t columns, std::size_t rows,
               const std::function<Rgb(std::size_t, std::size_t)>& pixel);
  /// Frame, ticks and grid. Steps of 0: none.
  void axes(const Axes& axes, double x_step, double y_step, const std::string& x_title, const std::string& y_title,
            Rgb grid, double grid_width);
  /// Everything until `end_clip` stays inside the axes.
  void begin_clip(const Axes& axes);
  void end_clip();
  const std::vector<ChartText>& texts() const { return texts_; }

 private:
  struct Box {
    double left, top, right, bottom;
  };
  cairo_t* cairo_;
  std::vector<ChartText> texts_;
  std::optional<Axes> clip_;
  std::vector<Box> taken_;
};

/// Lines of equal value on a grid of columns × rows in axis coordinates, joined to long lines. NaN: no value there.
struct Contour {
  std::vector<std::array<double, 2>> points;
};
std::vector<Contour> contours(const std::vector<double>& values, const std::vector<double>& x,
                              const std::vector<double>& y, double level);

/// A label that waits until everything it could hide is drawn.
struct PendingLabel {
  std::string text;
  Rgb colour;
  std::vector<LabelPlace> places;
};

/// Draws contours; `labels` gets the name for the longest of them, unless that is too short to be named.
void draw_contours(Chart& chart, const Axes& axes, const std::vector<Contour>& lines, Rgb colour, double width,
                   const std::string& label, std::vector<PendingLabel>& labels);
void draw_labels(Chart& chart, const std::vector<PendingLabel>& labels);

/// UTF-8 as it is; a byte that is none (file names may hold any) becomes '?'.
std::string printable(const std::string& text);

/// Writes `stem`.svg and `stem`.png (twice the size in pixels).
Status write_chart(const std::string& stem, double width, double height, const std::function<void(Chart&)>& draw);

}  // namespace phare
