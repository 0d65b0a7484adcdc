#include "tools/local_fit.h"

#include <algorithm>
#include <cmath>

namespace phare {
namespace {

FittedValue parabola(std::span<const double> times_s, std::span<const double> values, double t_s,
                     double half_window_s) {
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

/// The first sample behind the gap that holds `t_s`; 0: none does.
std::size_t behind_gap(std::span<const double> times_s, double t_s, double half_window_s) {
  const auto after = static_cast<std::size_t>(std::ranges::upper_bound(times_s, t_s) - times_s.begin());
  if (after == 0 || after == times_s.size() || times_s[after - 1] == t_s) return 0;
  const auto spacing = [&](std::size_t to) { return times_s[to] - times_s[to - 1]; };
  double beside = 0.0;
  if (after >= 2) beside = spacing(after - 1);
  if (after + 1 < times_s.size()) beside = std::max(beside, spacing(after + 1));
  return beside > 0.0 && spacing(after) > std::max(2.0 * half_window_s, 3.0 * beside) ? after : 0;
}

}  // namespace

FittedValue local_fit(std::span<const double> times_s, std::span<const double> values, double t_s,
                      double half_window_s) {
  if (times_s.empty()) return {};
  const auto at = [&](double time_s) { return parabola(times_s, values, time_s, half_window_s); };
  if (t_s < times_s.front() - half_window_s) return {at(times_s.front()).value, 0.0};
  if (t_s > times_s.back() + half_window_s) return {at(times_s.back()).value, 0.0};
  const std::size_t behind = behind_gap(times_s, t_s, half_window_s);
  if (behind == 0) return at(t_s);
  const double begin_s = times_s[behind - 1], width_s = times_s[behind] - begin_s, u = (t_s - begin_s) / width_s;
  const FittedValue from = at(begin_s), to = at(times_s[behind]);
  const double rise = to.value - from.value, m0 = width_s * from.slope, m1 = width_s * to.slope;
  const double c2 = 3.0 * rise - 2.0 * m0 - m1, c3 = m0 + m1 - 2.0 * rise;
  return {from.value + u * (m0 + u * (c2 + u * c3)), (m0 + u * (2.0 * c2 + u * 3.0 * c3)) / width_s};
}

}  // namespace phare
