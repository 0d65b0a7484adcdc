// The views of a beam that lighting engineers know, drawn into charts.
#pragma once

#include <string>
#include <vector>

#include "tools/lamp/chart.h"
#include "visual/photometry/check.h"
#include "visual/photometry/cutoff.h"
#include "visual/photometry/intensity_table.h"

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

/// 25 m wall: log candela in false colour or on white, isocandela lines, HV cross, rows of a check with their verdict.
void draw_wall(Chart& chart, const IntensityHv& intensity, const std::string& title, const std::string& subtitle,
               const CheckResult* check, bool coloured);

/// Bird's-eye isolux, on the road and facing the car side by side.
void draw_road(Chart& chart, const std::vector<RoadLamp>& lamps, const std::string& title, const std::string& subtitle);

/// Vertical cut at H with G.
void draw_cut(Chart& chart, const IntensityHv& intensity, double h_deg, const std::string& title,
              const std::string& subtitle);

/// False colour in bands over a wide field, with a legend in cd and lx at 25 m.
void draw_bands(Chart& chart, const IntensityHv& intensity, const std::string& title, const std::string& subtitle);

/// B over A: ratio in false colour (blue weaker, red stronger), with lines at factors.
void draw_ratio(Chart& chart, const IntensityHv& a, const IntensityHv& b, const std::string& title,
                const std::string& subtitle);

/// What B lights more (red) or less (blue) than A, lux facing the car, seen from above; and candela on the wall.
void draw_difference(Chart& chart, const IntensityHv& a, const IntensityHv& b, const std::vector<RoadLamp>& road_a,
                     const std::vector<RoadLamp>& road_b, const std::string& title, const std::string& subtitle);

inline constexpr double kPageWidth = 860.0, kPageHeight = 470.0;

}  // namespace phare
