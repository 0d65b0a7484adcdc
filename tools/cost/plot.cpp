#include "tools/cost/plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tools/lamp/chart.h"

namespace phare::cost {
namespace {

constexpr double kWidth = 720.0, kHeight = 440.0;
constexpr Rgb kWorth{0.0, 0.45, 0.7}, kOther{0.6, 0.6, 0.6}, kGrid{0.88, 0.88, 0.88};

/// A logarithmic axis about values above 0, from a 1, 2 or 5 to another; of values that are all 0, one of each.
struct Decades {
  double low = 0.0, high = 1.0;  ///< powers of ten
  std::vector<double> ticks{};   ///< of them, those that are named

  explicit Decades(const std::vector<double>& values) {
    double least = HUGE_VAL, most = 0.0;
    for (const double value : values) {
      if (!(value > 0.0)) continue;
      least = std::min(least, value);
      most = std::max(most, value);
    }
    if (most > 0.0) {
      const std::vector<double> steps = steps_between(std::floor(std::log10(least)), std::ceil(std::log10(most)) + 1.0);
      for (const double step : steps)
        if (step <= std::log10(least)) low = step;
      high = *std::ranges::find_if(steps, [&](double step) { return step >= std::log10(most) && step > low; });
    }
    const bool short_axis = high - low <= 2.0;
    for (const double step : steps_between(std::floor(low), high))
      if (step >= low && step <= high && (short_axis || step == std::round(step))) ticks.push_back(step);
  }
  /// 0 stands at the lower edge.
  double at(double value) const { return value > 0.0 ? std::log10(value) : low; }

 private:
  static std::vector<double> steps_between(double low, double high) {
    std::vector<double> steps;
    for (double decade = low; decade <= high; decade += 1.0)
      for (const double within : {0.0, std::log10(2.0), std::log10(5.0)}) steps.push_back(decade + within);
    return steps;
  }
};

std::string power_text(double exponent) {
  char text[16];
  std::snprintf(text, sizeof text, "%.3g", std::pow(10.0, exponent));
  return text;
}

std::vector<double> values_of(const Ladder& ladder, double (*value)(const Level&)) {
  std::vector<double> values;
  for (const Level& level : ladder.levels) values.push_back(value(level));
  return values;
}

void draw(Chart& chart, const Ladder& ladder) {
  const auto time = [](const Level& level) { return level.time.median; };
  const auto error = [](const Level& level) { return level.error.figure(); };
  const Decades times(values_of(ladder, time)), errors(values_of(ladder, error));
  const Axes axes{.left = 76,
                  .top = 44,
                  .width = kWidth - 100,
                  .height = kHeight - 104,
                  .x_min = times.low,
                  .x_max = times.high,
                  .y_min = errors.low,
                  .y_max = errors.high};
  chart.rectangle(0, 0, kWidth, kHeight, kWhite);
  chart.text(axes.left, 22, ladder.name + ": error against time", 15, -1, kBlack, true);
  for (const double e : times.ticks) {
    chart.line({{axes.x(e), axes.top}, {axes.x(e), axes.top + axes.height}}, kGrid, 1.0);
    chart.text(axes.x(e), axes.top + axes.height + 14, power_text(e), 11, 0, kBlack);
  }
  for (const double e : errors.ticks) {
    chart.line({{axes.left, axes.y(e)}, {axes.left + axes.width, axes.y(e)}}, kGrid, 1.0);
    chart.text(axes.left - 8, axes.y(e), power_text(e), 11, 1, kBlack);
  }
  chart.text(axes.left + 0.5 * axes.width, kHeight - 20, ladder.time_unit, 12, 0, kBlack);
  const bool rms = !ladder.levels.empty() && ladder.levels.front().error.rms.has_value();
  chart.vertical_text(18, axes.top + 0.5 * axes.height, (rms ? "rms error, " : "worst error, ") + ladder.error_unit, 12,
                      kBlack);

  const auto x = [&](const Level& level) { return axes.x(times.at(time(level))); };
  const auto y = [&](const Level& level) { return axes.y(errors.at(error(level))); };
  std::vector<const Level*> worth;
  for (const Level& level : ladder.levels)
    if (level.efficient) worth.push_back(&level);
  std::ranges::sort(worth, {}, [](const Level* level) { return level->time.median; });
  std::vector<std::array<double, 2>> joined;
  for (const Level* level : worth) joined.push_back({x(*level), y(*level)});
  if (joined.size() > 1) chart.line(joined, kWorth, 1.5);
  for (const Level& level : ladder.levels)
    chart.circle(x(level), y(level), level.efficient ? 4.5 : 3.0, level.efficient ? kWorth : kOther, 1.0, true);
  // No name off the page.
  chart.begin_clip({.left = 0, .top = axes.top - 12, .width = kWidth, .height = axes.height + 24});
  for (const bool of_worth : {true, false})
    for (const Level& level : ladder.levels) {
      if (level.efficient != of_worth) continue;
      std::vector<LabelPlace> places;
      for (const double up : {0.0, -13.0, 13.0, -26.0, 26.0, -39.0, 39.0})
        for (const int align : {-1, 1}) places.push_back({x(level) - 9.0 * align, y(level) + up, align});
      chart.label(places, level.name, 10, of_worth ? kWorth : kGrey, of_worth, true);
    }
  chart.end_clip();
}

}  // namespace

Status plot(const Ladder& ladder, const std::string& stem) {
  return write_chart(stem, kWidth, kHeight, [&](Chart& chart) { draw(chart, ladder); });
}

}  // namespace phare::cost
