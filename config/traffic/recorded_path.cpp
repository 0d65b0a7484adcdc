#include "config/traffic/recorded_path.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "config/formats/csv_table.h"
#include "config/traffic/bounds.h"

namespace phare {
namespace {

/// Slower, a way has no direction: a receiver that stands still wanders so. Chosen.
constexpr double kStands_mps = 0.1;

/// Slope at an inner row between secants before and behind it: their weighted harmonic mean, 0 at a turn.
double inner_slope(double step_before, double step_behind, double before, double behind) {
  if (before * behind <= 0.0) return 0.0;
  const double w = 2.0 * step_behind + step_before, v = step_behind + 2.0 * step_before;
  return (w + v) / (w / before + v / behind);
}

/// Slope at an end row: of the parabola through the three next to it, kept monotone.
double end_slope(double step_near, double step_far, double near, double far) {
  const double slope = ((2.0 * step_near + step_far) * near - step_near * far) / (step_near + step_far);
  if (slope * near <= 0.0) return 0.0;
  if (near * far <= 0.0 && std::abs(slope) > 3.0 * std::abs(near)) return 3.0 * near;
  return slope;
}

/// Cubic with values and slopes at both ends of a step, `share` of the way: value and slope.
struct Cubic {
  double value = 0.0, slope = 0.0;
};
Cubic hermite(double step, double share, double a, double b, double slope_a, double slope_b) {
  const double secant = (b - a) / step;
  const double square = (3.0 * secant - 2.0 * slope_a - slope_b) * step;
  const double cube = (slope_a + slope_b - 2.0 * secant) * step;
  return {a + share * (slope_a * step + share * (square + share * cube)),
          slope_a + share * (2.0 * square + share * 3.0 * cube) / step};
}

}  // namespace

Result<RecordedPath> RecordedPath::read(const std::filesystem::path& file) {
  const auto table = CsvTable::read(file);
  if (!table) return table.error();
  const std::string header = file.string() + ":" + std::to_string(table->header_line());
  const auto time = table->find({"time_s"}), s = table->find({"s_m"}), offset = table->find({"offset_m"}),
             x = table->find({"x_m"}), y = table->find({"y_m"}), heading = table->find({"heading_rad"});
  if (!time) return Error{header, "has no column time_s"};
  if ((s || offset) && (x || y || heading))
    return Error{header,
                 "has columns on the lane (s_m, offset_m) and in the world (x_m, y_m, heading_rad); one of both"};
  if (!s && !offset && !x && !y) return Error{header, "has neither columns s_m and offset_m nor x_m and y_m"};
  RecordedPath path;
  path.on_lane_ = s || offset;
  const auto first = path.on_lane_ ? s : x, second = path.on_lane_ ? offset : y;
  if (!first) return Error{header, std::string("has no column ") + (path.on_lane_ ? "s_m" : "x_m")};
  if (!second) return Error{header, std::string("has no column ") + (path.on_lane_ ? "offset_m" : "y_m")};
  if (table->rows() < 2) return Error{file.string(), "a path has at least two rows"};

  for (std::size_t i = 0; i < table->rows(); ++i) {
    const Row row{.time_s = table->at(i, *time),
                  .first_m = table->at(i, *first),
                  .second_m = table->at(i, *second),
                  .heading_rad = heading ? table->at(i, *heading) : 0.0};
    if (std::abs(row.time_s) > kLongestOfRoadUsers_s) return Error{table->place(i), "time_s is outside -1e9 … 1e9"};
    if (std::max(std::abs(row.first_m), std::abs(row.second_m)) > kFarthestOfRoadUsers_m)
      return Error{table->place(i), "a place is outside -1e6 … 1e6 m"};
    if (i > 0) {
      const Row& before = path.rows_.back();
      if (!(row.time_s > before.time_s)) return Error{table->place(i), "time_s does not rise"};
      const double way_m = std::hypot(row.first_m - before.first_m, row.second_m - before.second_m);
      if (!(way_m <= kFastestOfRoadUsers_kmh / 3.6 * (row.time_s - before.time_s)))
        return Error{table->place(i), "goes faster than 1000 km/h since the row before"};
    }
    path.rows_.push_back(row);
  }
  std::vector<Row>& rows = path.rows_;
  for (const auto& [place, slope] : {std::pair{&Row::first_m, &Row::first_mps}, {&Row::second_m, &Row::second_mps}}) {
    const auto step = [&](std::size_t i) { return rows[i + 1].time_s - rows[i].time_s; };
    const auto secant = [&](std::size_t i) { return (rows[i + 1].*place - rows[i].*place) / step(i); };
    const std::size_t last = rows.size() - 1;
    if (last == 1) {
      rows[0].*slope = rows[1].*slope = secant(0);
      continue;
    }
    rows[0].*slope = end_slope(step(0), step(1), secant(0), secant(1));
    for (std::size_t i = 1; i < last; ++i) rows[i].*slope = inner_slope(step(i - 1), step(i), secant(i - 1), secant(i));
    rows[last].*slope = end_slope(step(last - 1), step(last - 2), secant(last - 1), secant(last - 2));
  }
  if (!heading) path.look_along_the_way();
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double before = rows[i - 1].heading_rad;
    rows[i].heading_rad = before + std::remainder(rows[i].heading_rad - before, 2.0 * std::numbers::pi);
  }
  return path;
}

/// Who stands looks as he came; before he first moves, as he will go; who never moves, along the first axis.
void RecordedPath::look_along_the_way() {
  std::optional<double> heading_rad;
  const auto way = [](const Row& row) -> std::optional<double> {
    if (std::hypot(row.first_mps, row.second_mps) < kStands_mps) return std::nullopt;
    return std::atan2(row.second_mps, row.first_mps);
  };
  for (const Row& row : rows_)
    if (!heading_rad) heading_rad = way(row);
  for (Row& row : rows_) {
    if (const auto moves = way(row)) heading_rad = moves;
    row.heading_rad = heading_rad.value_or(0.0);
  }
}

RecordedPath::Place RecordedPath::at(double time_s) const {
  const double then_s = std::clamp(time_s, from_s(), to_s());
  const auto behind = std::ranges::upper_bound(rows_, then_s, {}, &Row::time_s);
  const Row& b = behind == rows_.end() ? rows_.back() : *behind;
  const Row& a = *(&b - 1);
  const double step = b.time_s - a.time_s, share = (then_s - a.time_s) / step;
  const Cubic first = hermite(step, share, a.first_m, b.first_m, a.first_mps, b.first_mps);
  const Cubic second = hermite(step, share, a.second_m, b.second_m, a.second_mps, b.second_mps);
  return {first.value, second.value, a.heading_rad + share * (b.heading_rad - a.heading_rad),
          std::hypot(first.slope, second.slope)};
}

}  // namespace phare
