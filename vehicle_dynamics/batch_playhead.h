// The inputs of a batch run at any time, and what its files share. For batch.cpp and batch_car.h only.
#pragma once

#include <algorithm>
#include <array>
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

// Every number finite: what is not makes its product with 0 not 0. Four sums, which do not wait for one another.
inline bool finite(const double* values, std::size_t count) {
  std::array<double, 4> sum{};
  std::size_t i = 0;
  for (; i + 4 <= count; i += 4)
    for (std::size_t k = 0; k < 4; ++k) sum[k] += values[i + k] * 0.0;
  for (; i < count; ++i) sum[0] += values[i] * 0.0;
  return sum[0] + sum[1] + sum[2] + sum[3] == 0.0;
}

}  // namespace phare::batch
