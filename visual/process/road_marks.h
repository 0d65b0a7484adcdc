// Lines over the picture that measure the road: a graduated grid ahead, isolux lines in the photo view, the scale of
// the false colours; and how far the beam reaches along the lane's edges, as numbers.
//
// All of it is computed on the processor, in float64, and drawn by the overlay's pass: what is off costs nothing.
// Isolux lines and reach are of the horizontal illuminance on the road as if nothing stood in the light; lines follow
// the road's height, and what a crest hides is not drawn. Checked by tests/visual_process/measuring_test.cpp.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "visual/image/versus_scale.h"
#include "visual/overlay_content.h"
#include "visual/process/lamps.h"
#include "visual/process/road_line.h"

namespace phare {

/// How far ahead the beam gives a level on an edge of the lane: the farthest metre that has it, from the car's origin.
struct Reach {
  double level_lx = 0.0, left_m = 0.0, right_m = 0.0;  ///< 0: nowhere

  friend bool operator==(const Reach&, const Reach&) = default;
};
inline constexpr std::array<double, 3> kReachLevels_lx{1.0, 3.0, 5.0};  // CIE 188:2010
inline constexpr double kLaneEdge_m = 1.75;                             ///< from its middle: a lane of 3.5 m
inline constexpr double kFarthestReach_m = 250.0;

/// Of the lamps that shine. Within 0.1 m where illuminance falls with distance.
std::vector<Reach> reach_of(const Lamps& lamps, const VehicleState& car, const RoadLine& road);
/// "reach left/right: 1 lx 74/96 m, 3 lx 51/70 m, 5 lx 42/60 m".
std::string reach_line(const std::vector<Reach>& reach);

/// Lines of the world, before they are seen by an eye.
struct RoadMarks {
  struct Line {
    std::vector<glm::dvec3> points_m;
    OverlayColour colour{};
  };
  struct Label {
    glm::dvec3 at_m{0.0};
    std::string text;
    OverlayColour colour{};
    std::vector<glm::dvec3> others_m{};  ///< places as good, for where the first is hidden or taken
  };
  std::vector<Line> lines;
  std::vector<Label> labels;
};

/// Across the road every `spacing_m` ahead of the car, and along it every 2 m to 6 m on either side; each line across
/// is labelled. Ten of them.
RoadMarks grid_marks(const VehicleState& car, const RoadLine& road, double spacing_m);
/// Lines of these levels on the road from 3 to 147 m ahead and 14 m to either side; each level labelled where it is
/// farthest, or along it where that place is taken.
RoadMarks isolux_marks(const Lamps& lamps, const VehicleState& car, const RoadLine& road,
                       const std::vector<double>& levels_lx);

/// Without what something hides from the eye, and what a crest hides from this one.
RoadMarks seen_marks(RoadMarks marks, const std::function<bool(const glm::dvec3& point_m)>& hides);
RoadMarks seen_marks(RoadMarks marks, const glm::dvec3& eye_m, const RoadLine& road);
/// As the eye sees them, all of them; no label on another of the picture or of `others`.
void draw_marks(OverlayMarks& picture, const RoadMarks& marks, const ViewGeometry& view,
                std::span<const OverlayMarks::Label> others = {});
/// The scale of the false colours at the right edge, with the levels of the isolux lines.
void draw_scale(OverlayMarks& picture, const std::vector<double>& levels_lx);

/// The scale of two designs compared by colour, there too.
void draw_versus_scale(OverlayMarks& picture, VersusScale scale);

/// Takes lines and labels off an inset, which shows another view.
void keep_clear(OverlayMarks& picture, const PicturePart& part);
/// Puts what was drawn for a view alone into the part of the picture that it has.
void put_into(OverlayMarks& marks, const PicturePart& part);
/// A frame around an inset.
void frame_part(OverlayMarks& picture, const PicturePart& part);

}  // namespace phare
