#include "vehicle_dynamics/start_pose.h"

namespace phare {

Result<CarState> start_of_lane(const std::filesystem::path& lane_file) {
  const Result<LanePoint> point = read_lane_start(lane_file);
  if (!point) return point.error();
  CarState start;
  start.x_m = point->x_m;
  start.y_m = point->y_m;
  start.z_m = point->z_m;
  start.yaw_rad = point->heading_rad;
  start.contact_z_m.fill(start.z_m);
  return start;
}

}  // namespace phare
