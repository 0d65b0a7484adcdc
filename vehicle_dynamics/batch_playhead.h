// The inputs of a batch run at any time, and what its files share. For batch.cpp and batch_car.h only.
#pragma once

#include <algorithm>
#include <cstdio>
#include <string>

#include "vehicle_dynamics/batch.h"

namespace phare::batch {

// Inputs at any time; rows are walked forwards only.
class Playhead {
 public:
  explicit Playhead(const Inputs& in) : in_(in) {}

  void go(double time_s) {
    while (row_ + 2 < in_.time_s.size() && in_.time_s[row_ + 1] <= time_s) ++row_;
    const double from = in_.time_s[row_], to = in_.time_s[std::min(row_ + 1, in_.time_s.size() - 1)];
    share_ = to > from ? std::clamp((time_s - from) / (to - from), 0.0, 1.0) : 0.0;
  }
  double linear(const std::vector<double>& column) const {
    if (column.empty()) return 0.0;
    return column[row_] + share_ * (column[std::min(row_ + 1, column.size() - 1)] - column[row_]);
  }
  std::size_t row() const { return row_; }
  double held(const std::vector<double>& column) const {
    return column.empty() ? 0.0 : column[share_ >= 1.0 ? std::min(row_ + 1, column.size() - 1) : row_];
  }

 private:
  const Inputs& in_;
  std::size_t row_ = 0;
  double share_ = 0.0;
};

inline std::string text_of(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

}  // namespace phare::batch
