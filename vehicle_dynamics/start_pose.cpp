#include "vehicle_dynamics/start_pose.h"

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace phare {
namespace {

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) {
    while (!cell.empty() && (cell.back() == '\r' || cell.back() == ' ')) cell.pop_back();
    cells.push_back(cell);
  }
  return cells;
}

}  // namespace

std::filesystem::path lane_file_of(const std::filesystem::path& scene_file) {
  return scene_file.parent_path() / (scene_file.stem().string() + "_lane.csv");
}

Result<CarState> start_of_lane(const std::filesystem::path& lane_file) {
  std::ifstream file(lane_file);
  std::string header, first;
  if (!file) return Error{lane_file.string(), "cannot be read"};
  if (!std::getline(file, header) || !std::getline(file, first)) return Error{lane_file.string(), "has no row"};
  const std::vector<std::string> names = cells_of(header), cells = cells_of(first);

  CarState start;
  std::map<std::string, double*> wanted{
      {"x_m", &start.x_m}, {"y_m", &start.y_m}, {"z_m", &start.z_m}, {"heading_rad", &start.yaw_rad}};
  for (std::size_t i = 0; i < names.size() && i < cells.size(); ++i) {
    const auto target = wanted.find(names[i]);
    if (target == wanted.end()) continue;
    try {
      std::size_t used = 0;
      *target->second = std::stod(cells[i], &used);
      if (used != cells[i].size() || !std::isfinite(*target->second)) throw std::invalid_argument("");
    } catch (const std::exception&) {
      return Error{lane_file.string() + ":2", "\"" + cells[i] + "\" in column " + names[i] + " is not a number"};
    }
    wanted.erase(target);
  }
  if (!wanted.empty()) return Error{lane_file.string() + ":1", "has no column " + wanted.begin()->first};
  start.contact_z_m.fill(start.z_m);
  return start;
}

}  // namespace phare
