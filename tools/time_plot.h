// A plot over time as SVG for a page: its colours are the page's (var(--ink) …), so that it prints dark on white.
#pragma once

#include <string>
#include <vector>

#include "tools/drive_series.h"

namespace phare {

struct TimePlot {
  std::string title{}, unit{};
  std::vector<TimeSeries> lines{};  ///< at most 8 are drawn, each with its name where there are several
  double from_s = 0.0, to_s = 1.0;
  bool from_zero = false;                 ///< the axis begins at 0
  std::vector<DriveSeries::Lit> bands{};  ///< in the background: what shone when
};

/// One <svg> element. Of many values in one column of it the least and the greatest are drawn, so no peak is lost.
std::string time_plot_svg(const TimePlot& plot);

/// 1, 2 or 5 times a power of ten, so that `most` steps at most cover the span.
double nice_step(double span, int most);

}  // namespace phare
