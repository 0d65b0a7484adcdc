// The line of a level road of bends, and what is laid along it: for town, motorway and tunnel. Frame: world, x east, y
// north, z up, m; a path begins at the origin and heads east; t is the offset to its left. Leaves out grades.
// Tests: tests/scene/made_scenes_test.cpp.
#pragma once

#include <functional>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "tools/scene/mesh.h"

namespace phare::scene {

/// Curvature rises from 0 at begin to 1/radius in the middle and sinks to 0 at end, as 1 - cos.
struct PathBend {
  double begin_m, end_m;
  double radius_m;  ///< the least, positive to the left
};

class Path {
 public:
  /// Drivable from 0 to `length_m`; goes on for `margin_m` at both ends.
  Path(double length_m, double margin_m, std::vector<PathBend> bends);

  double begin_m() const { return -margin_m_; }
  double end_m() const { return length_m_ + margin_m_; }
  double length_m() const { return length_m_; }
  double curvature_1pm(double s_m) const;
  double heading_rad(double s_m) const;
  glm::dvec3 point(double s_m, double t_m, double z_m = 0.0) const;
  /// Object frame at station and offset: x along the road turned left by turn_rad, z up.
  glm::dmat4 placed(double s_m, double t_m, double turn_rad = 0.0, double z_m = 0.0) const;
  /// CSV as lane_csv() of the country road: the line at `t_m`, each metre of its own arc length.
  std::string lane_csv(double t_m) const;

 private:
  double length_m_, margin_m_;
  std::vector<PathBend> bends_;
  std::vector<glm::dvec3> knots_;  ///< x, y, heading each metre
};

/// A strip between two lines along the path, from `begin` to `end` in pieces of at most `step`: of each line offset and
/// height. Seen from where (t0, z0) lies on the right of (t1, z1).
struct StripLine {
  double t_m, z_m;
};
void add_strip(Node& node, Material material, const Path& path, double begin, double end, double step, StripLine right,
               StripLine left);

/// "road_012": nodes of kPiece_m along the path, so that what is far away is culled.
inline constexpr double kPiece_m = 50.0;
void each_piece(const Path& path, const std::function<void(int number, double begin, double end)>& piece);
std::string numbered_node(const char* kind, int number);

/// A street lamp as its scene has it, for the TOML file that phare reads (config/street_lamps.h).
struct MadeLamp {
  const char* luminaire;
  glm::dvec3 position_m;
  double yaw_rad;  ///< of the street side
  double tilt_rad = 0.0;
};
/// A kind of luminaire that a scene's file names.
struct MadeLuminaire {
  const char* name;
  const char* file;
  double colour_temperature_k;
};
std::string street_lamps_toml(const char* heading, const std::vector<MadeLuminaire>& luminaires,
                              const std::vector<MadeLamp>& lamps);

/// Everything of a scene that is made.
struct MadeScene {
  Model model;
  std::string lane_csv;
  std::string street_lamps;  ///< empty: it has none
};
MadeScene make_town();
MadeScene make_motorway();
MadeScene make_tunnel();

/// Photometry of the luminaires, LM-63 type C, gamma 0 down, C 0 along the street, C 90 across it. File name and text.
std::vector<std::pair<std::string, std::string>> luminaire_files();

}  // namespace phare::scene
