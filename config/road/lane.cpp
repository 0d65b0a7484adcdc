#include "config/road/lane.h"

#include <algorithm>
#include <array>
#include <string>

#include "config/formats/csv_table.h"

namespace phare {
namespace {

struct LaneColumn {
  const char* name;
  double LanePoint::*to;
  bool of_start;  ///< a car can be put down by these
};
constexpr std::array<LaneColumn, 6> kLaneColumns{{{"s_m", &LanePoint::s_m, false},
                                                  {"x_m", &LanePoint::x_m, true},
                                                  {"y_m", &LanePoint::y_m, true},
                                                  {"z_m", &LanePoint::z_m, true},
                                                  {"heading_rad", &LanePoint::heading_rad, true},
                                                  {"curvature_1pm", &LanePoint::curvature_1pm, false}}};

Result<std::vector<LanePoint>> points_of(const std::filesystem::path& file, bool only_start) {
  const auto table = CsvTable::read(file);
  if (!table) return table.error();
  std::vector<LanePoint> points(only_start ? std::min<std::size_t>(table->rows(), 1) : table->rows());
  for (const LaneColumn& column : kLaneColumns) {
    const auto at = table->find({column.name});
    if (!at && (column.of_start || !only_start))
      return Error{file.string() + ":" + std::to_string(table->header_line()),
                   std::string("has no column ") + column.name};
    for (std::size_t row = 0; at && row < points.size(); ++row) points[row].*column.to = table->at(row, *at);
  }
  if (points.empty()) return Error{file.string(), "has no row"};
  for (std::size_t row = 1; row < points.size(); ++row)
    if (!(points[row].s_m > points[row - 1].s_m)) return Error{table->place(row), "s_m does not rise"};
  return points;
}

}  // namespace

std::filesystem::path lane_file_of(const std::filesystem::path& scene_file) {
  return scene_file.parent_path() / (scene_file.stem().string() + "_lane.csv");
}

Result<std::vector<LanePoint>> read_lane(const std::filesystem::path& file) {
  auto points = points_of(file, false);
  if (points && points->size() < 2) return Error{file.string(), "a lane has at least two points"};
  return points;
}

Result<std::vector<LanePoint>> lane_beside(const std::filesystem::path& scene_file) {
  const std::filesystem::path file = lane_file_of(scene_file);
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return std::vector<LanePoint>{};
  const auto table = CsvTable::read(file);
  if (!table) return table.error();
  if (table->rows() != 1) return points_of(file, false);
  const auto start = read_lane_start(file);
  return start ? Result(std::vector<LanePoint>{}) : start.error();
}

Result<LanePoint> read_lane_start(const std::filesystem::path& file) {
  const auto points = points_of(file, true);
  if (!points) return points.error();
  return points->front();
}

}  // namespace phare
