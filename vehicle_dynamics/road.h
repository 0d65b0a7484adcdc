// The road under the wheels: one question, whatever the road is made of.
#pragma once

#include <vector>

#include "config/road/road_friction.h"
#include "config/road/road_surface.h"
#include "config/road/road_surface_profile.h"

namespace phare {

/// The road at one wheel.
struct Ground {
  double z_m = 0.0;
  double friction = 1.0;  ///< 1: as the tyre was measured
};

/// Heights only: grade and bank are those of the plane through the four contacts, which the models work out. Plane or
/// triangles, and on top of it height profiles (profile file, roughness, bumps) and friction along the path. The
/// profiles are laid along what the car has travelled, so they need no straight road.
struct Road {
  const RoadSurface* mesh = nullptr;  ///< nullptr: the plane z = z_m + slope_x x + slope_y y
  double z_m = 0.0, slope_x = 0.0, slope_y = 0.0;
  std::vector<HeightProfile> profiles{};
  std::vector<FrictionZone> friction{};
  double friction_everywhere = 1.0;

  /// At world (x, y), `path_m` along the path, in the left or right track. Beside a mesh the height is `beside_m` and
  /// *off becomes true. No allocation; below a microsecond (road_profile_test.cpp).
  Ground at(double x_m, double y_m, double path_m, bool left, double beside_m, bool* off) const;

  /// Of it the height alone.
  double height_m(double x_m, double y_m, double path_m, bool left, double beside_m, bool* off) const;

  /// The two parts of at(): the mesh or plane there,
  double base_m(double x_m, double y_m, double beside_m, bool* off) const;
  /// and what lies on it along the path, for the left and the right wheel of an axle at once.
  struct Laid {
    Two z_m{}, slope{}, friction{};
  };
  Laid laid(double path_m) const;
  /// Of the mesh's material there, 1 where it says nothing: times what lies along the path.
  double base_friction(double x_m, double y_m) const {
    return mesh && mesh->has_friction() ? mesh->friction(x_m, y_m) : 1.0;
  }
  /// Whether base_m() asks where in the world it is; otherwise it is z_m everywhere.
  bool placed() const { return mesh || slope_x != 0.0 || slope_y != 0.0; }
};

inline Road::Laid Road::laid(double path_m) const {
  Laid both{Two{}, Two{}, phare::both(friction_everywhere)};
  for (const HeightProfile& profile : profiles) {
    const HeightProfile::Pair pair = profile.across(path_m);
    both.z_m += pair.z_m, both.slope += pair.slope;
  }
  for (const FrictionZone& zone : friction)
    if (path_m >= zone.from_m && path_m < zone.to_m) both.friction = Two{zone.left, zone.right};
  return both;
}

}  // namespace phare
