#include "vehicle_dynamics/road.h"

namespace phare {

Ground Road::at(double x_m, double y_m, double path_m, bool left, double beside_m, bool* off) const {
  Ground ground;
  if (mesh) {
    const auto point = mesh->at(x_m, y_m);
    ground.z_m = point ? point->z_m : beside_m;
    if (!point) *off = true;
  } else {
    ground.z_m = z_m + slope_x * x_m + slope_y * y_m;
  }
  for (const HeightProfile& profile : profiles) ground.z_m += profile.at(path_m, left).z_m;
  ground.friction = friction_everywhere;
  for (const FrictionZone& zone : friction)
    if (path_m >= zone.from_m && path_m < zone.to_m) ground.friction = left ? zone.left : zone.right;
  return ground;
}

}  // namespace phare
