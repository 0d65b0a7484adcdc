#include "tools/local_fit.h"

#include <algorithm>
#include <cmath>

namespace phare {

FittedValue local_fit(std::span<const double> times_s, std::span<const double> values, double t_s,
                      double half_window_s) {
  if (times_s.empty()) return {};
  auto low = std::lower_bound(times_s.begin(), times_s.end(), t_s - half_window_s) - times_s.begin();
  auto high = std::upper_bound(times_s.begin(), times_s.end(), t_s + half_window_s) - times_s.begin();
  const auto count = static_cast<std::ptrdiff_t>(times_s.size());
  while (high - low < 4 && (low > 0 || high < count)) {
    const auto at = [&](std::ptrdiff_t i) { return times_s[static_cast<std::size_t>(i)]; };
    const bool take_low = low > 0 && (high == count || t_s - at(low - 1) <= at(high) - t_s);
    take_low ? --low : ++high;
  }
  const auto first = static_cast<std::size_t>(low), last = static_cast<std::size_t>(high);
  double reach = half_window_s;
  for (std::size_t i = first; i < last; ++i) reach = std::max(reach, std::abs(times_s[i] - t_s) * 1.0001);

  // Normal equations of value = a + b u + c u², u = (t - t_s) / reach, so that they are well scaled.
  double s[5] = {}, r[3] = {};
  for (std::size_t i = first; i < last; ++i) {
    const double u = (times_s[i] - t_s) / reach;
    const double lever = 1.0 - std::abs(u * u * u);
    const double weight = lever * lever * lever;
    double power = weight;
    for (int k = 0; k < 5; ++k, power *= u) {
      s[k] += power;
      if (k < 3) r[k] += power * values[i];
    }
  }
  const double determinant =
      s[0] * (s[2] * s[4] - s[3] * s[3]) - s[1] * (s[1] * s[4] - s[2] * s[3]) + s[2] * (s[1] * s[3] - s[2] * s[2]);
  if (!(determinant > 1e-12 * s[0] * s[0] * s[0])) {
    return {s[0] > 0.0 ? r[0] / s[0] : values[first], 0.0};
  }
  const double a =
      (r[0] * (s[2] * s[4] - s[3] * s[3]) - s[1] * (r[1] * s[4] - r[2] * s[3]) + s[2] * (r[1] * s[3] - r[2] * s[2])) /
      determinant;
  const double b =
      (s[0] * (r[1] * s[4] - r[2] * s[3]) - r[0] * (s[1] * s[4] - s[2] * s[3]) + s[2] * (s[1] * r[2] - s[2] * r[1])) /
      determinant;
  return {a, b / reach};
}

}  // namespace phare
