// All that can be told of light at a point, lamp by lamp, in float64 from the tables themselves: for the click in the
// window and for `phare control set point`.
//
// Illuminance is that of `phare measure` (visual/photometry/table/illuminance.h), behind what stands in the scene.
// Luminance is that of the material's mean reflectance, L = rho·E/pi, what markings, signs and rough ground send back
// to the eye (visual/scene/retro.h), and what the material emits, on the mean. Checked by
// tests/visual_process/measuring_test.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "visual/fixed_light.h"
#include "visual/process/lamps.h"
#include "visual/process/road_line.h"

namespace phare {

/// Why a lamp gives a point no light.
enum class WhyDark { kLit, kOff, kBehindLamp, kOutOfTable, kNoLightThere, kFacesAway, kHidden };

struct LampReading {
  std::string lamp;
  WhyDark why = WhyDark::kLit;
  std::string hidden_by{};  ///< node of the scene, where it is hidden
  double h_deg = 0.0,
         v_deg = 0.0;    ///< of the point, seen from the lamp as it is aimed: right, up; of its first lit source
  double candela = 0.0;  ///< toward the point, all lit sources
  double distance_m = 0.0;
  double surface_lx = 0.0, horizontal_lx = 0.0, vertical_lx = 0.0, eye_lx = 0.0;
  double facing_lx = 0.0;  ///< on a surface that faces this lamp
};

struct PointReading {
  std::string node, material;  ///< what lies there; empty: nothing is known
  MeasurePoint world;
  glm::dvec3 car_m{0.0};
  std::optional<RoadLine::Place> road;
  double surface_lx = 0.0;      ///< on the surface itself
  double horizontal_lx = 0.0;   ///< on a level surface that looks up
  double vertical_lx = 0.0;     ///< on an upright one that looks back along the car's heading
  double eye_lx = 0.0;          ///< on one that faces the eye
  double luminance_cdm2 = 0.0;  ///< toward the eye
  double sent_back_cdm2 = 0.0;  ///< of it: what is sent back to where it came from
  std::vector<LampReading> lamps;
  /// Street lamps, the moon and what walls and roof reflect, beside the car's own lamps, on the surface: in none of the
  /// sums above.
  double fixed_lx = 0.0;
  std::vector<FixedLight::Share> fixed{};  ///< strongest first
};

/// `eye_m`: world. `shadows`: false as if nothing stood in the light. `fixed`: what shines in the scene itself; null:
/// nothing is asked. `snow_cover_01`: share of level ground under snow.
PointReading read_point(const Lamps& lamps, const VehicleState& car, const MeasurePoint& at, const glm::dvec3& eye_m,
                        const World& world, const RoadLine& road, bool shadows, const FixedLight* fixed = nullptr,
                        double snow_cover_01 = 0.0);

/// The reading as lines: the sums, where it is, then each lamp.
std::vector<std::string> lines_of(const PointReading& reading);

}  // namespace phare
