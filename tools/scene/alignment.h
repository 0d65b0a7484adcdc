// The line, profile and cross-section of the country road, and the ground beside it, as functions of station and
// offset. What: where a point "s metres along the road, t metres to its left" lies. Source: layout by us, after the
// German rural road guide RAL (lane 3.25 m, crossfall 2.5 %). Frame: world, x east, y north, z up, m; the road begins
// at the origin and heads east. Leaves out: junctions, widening in curves. Tests: tests/scene.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace phare::scene {

inline constexpr double kLength_m = 1800.0;  ///< of the part that can be driven, from s = 0
inline constexpr double kMargin_m = 60.0;    ///< the road goes on that far before 0 and after kLength_m
inline constexpr double kLaneWidth_m = 3.25;
inline constexpr double kLaneCentre_m = -1.625;    ///< offset of the right-hand lane's centre
inline constexpr double kPavedHalfWidth_m = 3.75;  ///< lanes, edge line and a strip of asphalt outside it
inline constexpr double kCrossfall = 0.025;

/// A bend: curvature rises from 0 at begin to 1/radius at full_begin, stays, and is 0 again at end.
struct Bend {
  double begin_m, full_begin_m, full_end_m, end_m;
  double radius_m;  ///< of the centreline, positive to the left
};
inline constexpr Bend kFirstBend{300.0, 380.0, 520.0, 600.0, 200.0};
inline constexpr Bend kSecondBend{1220.0, 1300.0, 1440.0, 1520.0, -180.0};

/// A hump or a hollow of the profile, 64 h u³ with u = (s - begin)/length · (end - s)/length: continuous up to
/// curvature. Its peak curvature is 24 |h| / length², its steepest grade about 3.4 |h| / length.
struct Hump {
  double begin_m, end_m, height_m;
  double middle_m() const { return 0.5 * (begin_m + end_m); }
};
inline constexpr Hump kCrest{640.0, 940.0, 6.0};  // vertical radius at the top 625 m
inline constexpr Hump kDip{960.0, 1180.0, -4.0};  // vertical radius at the bottom 504 m

/// Position and direction of the centreline at one station.
struct Station {
  glm::dvec3 position_m;
  double heading_rad;
  double curvature_1pm;        ///< positive to the left
  glm::dvec3 forward() const;  ///< level
  glm::dvec3 left() const;     ///< level
};

class Alignment {
 public:
  Alignment();

  Station at(double s_m) const;
  /// Height of the finished surface: road within the paved width, ground outside; the ground is as wide as |t| = 130 m.
  double height_m(double s_m, double t_m) const;
  /// The point at station and offset, on the surface.
  glm::dvec3 point(double s_m, double t_m) const;

 private:
  struct Knot {
    double x_m, y_m;
  };
  std::vector<Knot> knots_;  // each kKnotStep_m from -kTable_m
};

double curvature_1pm(double s_m);
double heading_rad(double s_m);
double profile_m(double s_m);  ///< height of the centreline
/// 0 at a and below, 1 at b and above, flat at both.
double smooth_step(double a, double b, double x);

}  // namespace phare::scene
