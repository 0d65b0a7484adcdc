#include "visual/process/probe_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "visual/process/road_marks.h"

namespace phare {
namespace {

constexpr OverlayMarks::Box kBox{0.60, 0.36, 0.32, 0.24, {30, 36, 42}, 175};
/// Apart for eyes that confuse red and green (Okabe and Ito 2008).
constexpr std::array<OverlayColour, 6> kInks{
    {{230, 159, 0}, {86, 180, 233}, {0, 158, 115}, {240, 228, 66}, {213, 94, 0}, {204, 121, 167}}};

/// The least of 1, 2, 5 times a power of ten that is not below.
double round_up(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(std::max(value, 1e-3))));
  for (const double step : {1.0, 2.0, 5.0})
    if (step * decade >= value) return step * decade;
  return 10.0 * decade;
}

}  // namespace

void ProbePlot::add(SimTime now, std::vector<std::optional<double>> lx) {
  if (!rows_.empty() && (now < rows_.back().time || lx.size() != rows_.back().lx.size())) rows_.clear();
  rows_.push_back({now, std::move(lx)});
  while (rows_.back().time.seconds() - rows_.front().time.seconds() > kSpan_s) rows_.pop_front();
}

void ProbePlot::draw(OverlayMarks& picture, std::size_t probes) const {
  if (rows_.empty()) return;
  keep_clear(picture, {kBox.left_01, kBox.top_01, kBox.width_01, kBox.height_01});
  picture.boxes.push_back(kBox);
  constexpr double kEdge_01 = 0.012, kNames_01 = 0.095;
  const double left = kBox.left_01 + kEdge_01, width = kBox.width_01 - kEdge_01 - kNames_01;
  const double top = kBox.top_01 + 0.045, height = kBox.height_01 - 0.09;
  const std::size_t values = rows_.back().lx.size();
  double most_lx = 0.0;
  for (const Row& row : rows_)
    for (const std::optional<double>& lx : row.lx) most_lx = std::max(most_lx, lx.value_or(0.0));
  const double full_lx = round_up(most_lx);
  const double end_s = rows_.back().time.seconds();
  const auto x_of = [&](SimTime time) { return left + width * (1.0 - (end_s - time.seconds()) / kSpan_s); };
  const auto y_of = [&](double lx) { return top + height * (1.0 - lx / full_lx); };
  constexpr OverlayColour kFaint{120, 125, 130};
  for (const double share : {0.0, 0.5, 1.0})
    picture.lines.push_back({left, y_of(share * full_lx), left + width, y_of(share * full_lx), kFaint});
  const double room = kBox.width_01 - kEdge_01;
  picture.labels.push_back(
      {left, top - 0.022, values == 0 ? "no probe and no point is set" : fmt::format("{:g} lx", full_lx), {}, room});
  picture.labels.push_back({left, top + height + 0.018, fmt::format("{:g} s ago", kSpan_s), {}, room});
  for (std::size_t k = 0; k < values; ++k) {
    const OverlayColour ink = kInks[k % kInks.size()];
    for (std::size_t i = 1; i < rows_.size(); ++i)
      if (rows_[i - 1].lx[k] && rows_[i].lx[k])
        picture.lines.push_back(
            {x_of(rows_[i - 1].time), y_of(*rows_[i - 1].lx[k]), x_of(rows_[i].time), y_of(*rows_[i].lx[k]), ink});
    // Under each other from the top: lines that end together keep their names apart.
    constexpr double kRow_01 = 0.03;
    const auto rows_that_fit = static_cast<std::size_t>(height / kRow_01) + 1;
    if (k >= rows_that_fit) continue;
    const std::string name = k < probes ? std::to_string(k + 1) : "point";
    const std::optional<double>& now = rows_.back().lx[k];
    constexpr double kGap_01 = 0.008;
    picture.labels.push_back({left + width + kGap_01, top + kRow_01 * static_cast<double>(k),
                              name + (now ? fmt::format(": {:.3g}", *now) : ": -"), ink, kNames_01 - kGap_01});
  }
}

}  // namespace phare
