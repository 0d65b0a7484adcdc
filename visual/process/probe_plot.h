// Lux at the probes over the last seconds, as lines over the picture. Checked by
// tests/visual_process/measuring_test.cpp.
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "net/clock.h"
#include "visual/overlay_content.h"

namespace phare {

class ProbePlot {
 public:
  static constexpr double kSpan_s = 20.0;

  /// Ten times a second of simulated time, each tenth once.
  bool due(SimTime now) const { return rows_.empty() || now.ns / kEvery_ns != rows_.back().time.ns / kEvery_ns; }
  /// What the probes have now, and behind them the chosen point where there is one; nothing: it is nowhere. A time
  /// before the newest, or another number of values, begins anew.
  void add(SimTime now, std::vector<std::optional<double>> lx);
  void clear() { rows_.clear(); }
  /// A box at the right edge: seconds from left to right, lux from 0 to a round number, a line for each value with its
  /// number and what it is now. `probes`: how many of the values are probes.
  void draw(OverlayMarks& picture, std::size_t probes) const;

 private:
  static constexpr std::int64_t kEvery_ns = 100'000'000;
  struct Row {
    SimTime time{};
    std::vector<std::optional<double>> lx;
  };
  std::deque<Row> rows_;
};

}  // namespace phare
