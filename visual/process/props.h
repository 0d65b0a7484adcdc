// What some cameras show besides the scene and its road users: the car's own body, from outside, and a wall at 25 m to
// read the beam on. Neither is there for measuring: probes, reach and self-audit know nothing of them, and a view that
// shows neither has no mesh more. Checked by tests/visual_process/props_test.cpp.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "visual/process/lamps.h"
#include "visual/process/movers.h"
#include "visual/process/road_marks.h"
#include "visual/renderer.h"

namespace phare {

/// UN R149, annex 4: beams are measured at 25 m.
inline constexpr double kWall_m = 25.0;

/// Middle of the lamps of a design with a low beam, in the car's frame, m; of a design without one that of all lamps.
glm::dvec3 middle_of_low_beam(const DesignConfig& design, const Lamps::Mounts& mounts);

/// A wall kWall_m before the low beam's middle, upright, across the car's heading.
struct Wall {
  glm::dvec3 lamps_m{0.0};          ///< the low beam's middle in the world
  glm::dmat3 world_from_wall{1.0};  ///< columns: the car's heading, left, up; level
  double ground_z_m = 0.0;          ///< of the road below the car
};
Wall wall_before(const Lamps& lamps, const VehicleState& car);
/// Level at the lamps' height, between them: the angles of the beam are those of the picture.
Camera wall_camera(const Wall& wall);
/// H-H and V-V through the point straight before the lamps, lines every 5 degrees to 20 aside and 10 up, and
/// their names: azimuth from V-V, elevation from H-H along V-V, as a screen at 25 m has them.
RoadMarks wall_marks(const Wall& wall);

class Props {
 public:
  Props() = default;
  /// Error: `movers` lacks a mesh.
  static Result<Props> of(const Movers& movers);

  /// From outside the car one sees it: every camera but the driver's, the mirrors and the wall's, unless it stands
  /// within the car.
  static bool shows_own_car(CameraKind kind, const Camera& camera, const VehicleState& car);
  /// The car's body where this camera shows it.
  std::optional<PlacedMesh> own_car_in(CameraKind kind, const Camera& camera, const VehicleState& car) const;
  /// Puts into a view what its camera shows. The car's body carries its own lamps and casts no shadow in their light;
  /// its tail lamps, which are returned, shine (`lit`) into the eye that sees it, where nothing of `world` is between.
  /// What shines into the eye, which the view has already, shines through no wall. `world` has the meshes of what
  /// moves.
  std::vector<GlaringLamp> add_to(ViewInput& view, CameraKind kind, const Lamps& lamps, const VehicleState& car,
                                  bool lit, const World& world) const;
  /// Both, for a warm-up.
  std::vector<PlacedMesh> one_of_each(const glm::dvec3& place_m) const;

 private:
  std::size_t car_ = 0, wall_ = 0;
};

}  // namespace phare
