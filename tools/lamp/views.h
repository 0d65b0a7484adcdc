// The views of a beam that lighting engineers know, drawn into charts.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "tools/lamp/chart.h"
#include "tools/lamp/view_parts.h"
#include "visual/photometry/bench/check.h"
#include "visual/photometry/bench/cutoff.h"
#include "visual/photometry/table/intensity_table.h"

namespace phare {

/// One lamp of a pair on the car, for views of the road.
struct RoadLamp {
  const IntensityTable* table = nullptr;
  double y_m = 0.0, z_m = 0.65;
  double pitch_deg = 0.0;  ///< up positive
  double yaw_deg = 0.0;    ///< left positive
};

/// Lux at a point of the road from all lamps; `facing`: on a vertical plane that faces the car, else on the road.
double road_lux(const std::vector<RoadLamp>& lamps, double x_m, double y_m, double z_m, bool facing);

/// Edges of two lanes of 3.5 m, y left positive, with the car (y = 0) in the middle of its own: the right one where
/// traffic keeps right.
constexpr std::array<double, 3> lane_lines_m(bool left_hand) {
  return left_hand ? std::array<double, 3>{1.75, -1.75, -5.25} : std::array<double, 3>{-1.75, 1.75, 5.25};
}

/// Ids of the rows whose place is not wholly on the page of `draw_wall`, failed ones first.
std::vector<std::string> rows_beyond_wall(const CheckResult& check);

/// 25 m wall: log candela in false colour or on white, isocandela lines, HV cross, rows of a check with their verdict.
/// On white the cut-off too, as scans find it, and its kink.
void draw_wall(Chart& chart, const IntensityHv& intensity, const std::string& title, const std::string& subtitle,
               const CheckResult* check, bool coloured);

/// A measured value of a list of points.
struct PointMark {
  HV at;
  double cd = 0.0;
};

/// The same wall with measured points and their candela in place of a beam; rows of a check as above.
void draw_point_wall(Chart& chart, const std::vector<PointMark>& points, const std::string& title,
                     const std::string& subtitle, const CheckResult* check);

/// How far a view of the road reaches: to where 1 lx ends, at most 400 m ahead and 60 m aside.
struct RoadExtent {
  double ahead_m = 0.0, aside_m = 0.0;
  bool clipped = false;  ///< 1 lx goes on beyond
};
RoadExtent road_extent(const std::vector<RoadLamp>& lamps, bool facing);

/// Bird's-eye isolux, on the road and facing the car side by side.
void draw_road(Chart& chart, const std::vector<RoadLamp>& lamps, bool left_hand, const std::string& title,
               const std::string& subtitle);

/// Bounds of G that hold for the beam, and whose they are; both 0: none.
struct SharpnessLimits {
  double least = 0.0, most = 0.0;
  std::string of;
};
/// Vertical cut at H with G.
void draw_cut(Chart& chart, const IntensityHv& intensity, double h_deg, const SharpnessLimits& limits,
              const std::string& title, const std::string& subtitle);

/// False colour in bands over a wide field, with a legend in cd and lx at 25 m.
void draw_bands(Chart& chart, const IntensityHv& intensity, const std::string& title, const std::string& subtitle);

/// B over A: ratio in false colour (blue weaker, red stronger), with lines at factors.
void draw_ratio(Chart& chart, const IntensityHv& a, const IntensityHv& b, const std::string& title,
                const std::string& subtitle);

/// What B lights more (red) or less (blue) than A, lux facing the car, seen from above; and candela on the wall.
void draw_difference(Chart& chart, const IntensityHv& a, const IntensityHv& b, const std::vector<RoadLamp>& road_a,
                     const std::vector<RoadLamp>& road_b, const std::string& title, const std::string& subtitle);

}  // namespace phare
