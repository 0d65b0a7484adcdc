// What the views of a beam have in common: sampled grids, headings, colour bars, names of numbers.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tools/lamp/chart.h"

namespace phare {

inline constexpr double kPageWidth = 860.0, kPageHeight = 490.0;

/// 350, 10k
std::string short_number(double value);

struct Grid {
  std::vector<double> x, y, values;                             ///< values[y][x]
  double at_pixel(std::size_t column, std::size_t row) const {  ///< first row at the top of a picture
    return values[(y.size() - 1 - row) * x.size() + column];
  }
};
Grid sample_grid(const std::function<double(double, double)>& f, double x_min, double x_max, double y_min, double y_max,
                 std::size_t columns, std::size_t rows);

/// Where there is no value (NaN).
inline constexpr Rgb kNoDataColour{0.72, 0.74, 0.76};
/// Tells what the grey is, where the grid has some.
void draw_no_data_note(Chart& chart, double x, double y, const Grid& grid);

void heading(Chart& chart, const std::string& title, const std::string& subtitle);

/// A mark on a colour bar; `value` on its scale.
struct BarMark {
  double value;
  std::string left, right;  ///< texts on either side; empty: none
};
/// An upright bar from `low` at its foot to `high`.
void colour_bar(Chart& chart, double left, double top, double height, double low, double high,
                const std::function<Rgb(double)>& colour, const std::vector<BarMark>& marks);

/// Blue below 0, white at 0, red above; full at ±1.
Rgb difference_colour(double t);

}  // namespace phare
