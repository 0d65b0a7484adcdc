#include "tools/import_track.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "config/road/lane.h"
#include "tools/csv_columns.h"

namespace phare {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180.0;

void unwrap(std::vector<double>& angles_rad) {
  for (std::size_t i = 1; i < angles_rad.size(); ++i) {
    const double turns = std::round((angles_rad[i] - angles_rad[i - 1]) / (2.0 * std::numbers::pi));
    angles_rad[i] -= turns * 2.0 * std::numbers::pi;
  }
}

Status check_ascending(const std::vector<double>& values, const std::filesystem::path& file, const char* column) {
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (!(values[i] > values[i - 1])) {
      return Error{file.string(), std::string("\"") + column + "\" does not ascend at row " + std::to_string(i + 1)};
    }
  }
  if (values.size() < 2) return Error{file.string(), "needs at least two rows"};
  return Done{};
}

}  // namespace

ImportLane::Point ImportLane::at(double s) const {
  const auto after = std::upper_bound(s_m.begin() + 1, s_m.end() - 1, s);
  const auto j = static_cast<std::size_t>(after - s_m.begin()), i = j - 1;
  const double h = s_m[j] - s_m[i], u = (s - s_m[i]) / h;
  const double h00 = (1 + 2 * u) * (1 - u) * (1 - u), h10 = u * (1 - u) * (1 - u);
  const double h01 = u * u * (3 - 2 * u), h11 = u * u * (u - 1);
  const auto mix = [&](double a, double b) { return a + u * (b - a); };
  const double grade_i = grade(i), grade_j = grade(j);
  return {h00 * x_m[i] + h10 * h * std::cos(heading_rad[i]) + h01 * x_m[j] + h11 * h * std::cos(heading_rad[j]),
          h00 * y_m[i] + h10 * h * std::sin(heading_rad[i]) + h01 * y_m[j] + h11 * h * std::sin(heading_rad[j]),
          h00 * z_m[i] + h10 * h * grade_i + h01 * z_m[j] + h11 * h * grade_j,
          mix(heading_rad[i], heading_rad[j]),
          mix(curvature_1pm[i], curvature_1pm[j]),
          mix(grade_i, grade_j)};
}

double ImportLane::grade(std::size_t i) const {
  const std::size_t a = i == 0 ? 0 : i - 1, b = std::min(i + 1, s_m.size() - 1);
  return (z_m[b] - z_m[a]) / (s_m[b] - s_m[a]);
}

Result<ImportLane> import_lane(const std::filesystem::path& file) {
  const auto points = read_lane(file);
  if (!points) return points.error();
  ImportLane lane;
  for (const LanePoint& point : *points) {
    lane.s_m.push_back(point.s_m);
    lane.x_m.push_back(point.x_m);
    lane.y_m.push_back(point.y_m);
    lane.z_m.push_back(point.z_m);
    lane.heading_rad.push_back(point.heading_rad);
    lane.curvature_1pm.push_back(point.curvature_1pm);
  }
  unwrap(lane.heading_rad);
  return lane;
}

Result<ImportPose> read_import_pose(const std::filesystem::path& file) {
  const std::array<std::string, 6> names{"t_s",           "east_m", "north_m", "up_m", "heading_deg_cw_from_north",
                                         "path_pitch_deg"};
  auto columns = read_csv_columns(file, names);
  if (!columns) return columns.error();
  auto& c = *columns;
  ImportPose pose{std::move(c[0]), std::move(c[1]), std::move(c[2]), std::move(c[3]), std::move(c[4]), std::move(c[5])};
  if (const Status status = check_ascending(pose.t_s, file, "t_s"); !status) return status.error();
  for (double& angle : pose.yaw_rad) angle = std::numbers::pi / 2.0 - angle * kDegree_rad;
  for (double& angle : pose.pitch_rad)
    angle = -angle * kDegree_rad;  // the table's is positive uphill, ISO 8855's nose down
  unwrap(pose.yaw_rad);
  return pose;
}

}  // namespace phare
