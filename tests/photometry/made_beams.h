// Beams with a cut-off of any form, as a goniometer would file them: for the tests of cut-off shapes.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "visual/photometry/table/intensity_table.h"

namespace phare::test {

struct MadeBeam {
  std::function<double(double h_deg)> line;  ///< elevation of the cut-off
  double soft_deg = 0.1;                     ///< s of the logistic fall in log I; G is about log10(contrast)·0.025°/s
  double column_deg = 0.1, row_deg = 0.05;
  double noise_01 = 0.0;                 ///< of each value, one sigma
  double right_deg = 0.0, up_deg = 0.0;  ///< turned
  double wide_deg = 20.0;                ///< the table's reach to both sides
  unsigned seed = 1;
};

/// A hot spot below the cut-off and a foreground, 80 cd above it.
inline IntensityTable made_beam(const MadeBeam& beam) {
  IntensityTable table;
  table.name = "made";
  const int columns = static_cast<int>(std::lround(beam.wide_deg / beam.column_deg));
  const int below = static_cast<int>(std::lround(8.0 / beam.row_deg)),
            above = static_cast<int>(std::lround(5.0 / beam.row_deg));
  for (int i = -columns; i <= columns; ++i) table.first_deg.push_back(i * beam.column_deg);
  for (int j = -below; j <= above; ++j) table.second_deg.push_back(j * beam.row_deg);
  std::mt19937 random(beam.seed);
  std::normal_distribution<double> normal;
  for (const double v : table.second_deg) {
    for (const double h : table.first_deg) {
      const double x = h - beam.right_deg, y = v - beam.up_deg;
      const double spot = 26000.0 / (1.0 + 0.02 * (x - 1.0) * (x - 1.0) + 0.35 * (y + 1.3) * (y + 1.3));
      const double bright = 1500.0 + spot, stray = 80.0;
      const double share = 1.0 / (1.0 + std::exp((y - beam.line(x)) / beam.soft_deg));
      const double cd = stray * std::pow(bright / stray, share);
      table.candela.push_back(cd * std::max(0.0, 1.0 + beam.noise_01 * normal(random)));
    }
  }
  return table;
}

/// From `low` to `high`, upright at H = `at`, then on at `slope`.
inline std::function<double(double)> step_line(double low, double high, double at, double slope = 0.0) {
  return [=](double h) { return h < at ? low : high + slope * (h - at); };
}

}  // namespace phare::test
