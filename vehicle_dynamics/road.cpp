#include "vehicle_dynamics/road.h"

namespace phare {

double Road::base_m(double x_m, double y_m, double beside_m, bool* off) const {
  if (!mesh) return z_m + slope_x * x_m + slope_y * y_m;
  const std::optional<double> height_m = mesh->height_m(x_m, y_m);
  if (!height_m) *off = true;
  return height_m.value_or(beside_m);
}

double Road::height_m(double x_m, double y_m, double path_m, bool left, double beside_m, bool* off) const {
  double z = base_m(x_m, y_m, beside_m, off);
  for (const HeightProfile& profile : profiles) z += profile.at(path_m, left).z_m;
  return z;
}

Ground Road::at(double x_m, double y_m, double path_m, bool left, double beside_m, bool* off) const {
  Ground ground{height_m(x_m, y_m, path_m, left, beside_m, off), friction_everywhere};
  for (const FrictionZone& zone : friction)
    if (path_m >= zone.from_m && path_m < zone.to_m) ground.friction = left ? zone.left : zone.right;
  ground.friction *= base_friction(x_m, y_m);
  return ground;
}

}  // namespace phare
