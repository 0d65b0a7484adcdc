// The road's own coordinates: s along the lane of the scene, lateral to its left, and the height of what is drawn
// there.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "config/desk.h"
#include "config/road/lane.h"
#include "config/road/road_surface.h"
#include "net/messages.h"
#include "visual/renderer.h"

namespace phare {

class RoadLine {
 public:
  RoadLine() = default;
  /// `lane`: of the scene, may be empty; then s and lateral are the car's x and y. The surface is read when the first
  /// height is asked for, or before.
  RoadLine(std::vector<LanePoint> lane, std::filesystem::path scene_file);
  void prepare() const { (void)surface(); }

  struct Place {
    double s_m = 0.0, lateral_m = 0.0;  ///< lateral: to the left
  };
  bool has_lane() const { return lane_.size() >= 2; }
  /// Nearest point of the lane, by its segments; nothing without one.
  std::optional<Place> place_of(const glm::dvec3& world_m) const;
  /// On the road there, with its normal; before the first and behind the last point straight on. Where nothing is
  /// drawn: at the lane's height, normal up.
  MeasurePoint at(const Place& place) const;
  /// The same from below or above (x, y); `z_m`: where nothing is drawn.
  MeasurePoint ground(double x_m, double y_m, double z_m) const;
  /// Ahead of a car: along the lane where it has one and the car is within 10 m of it, else straight on.
  class Ahead {
   public:
    MeasurePoint operator()(double ahead_m, double left_m) const;

   private:
    friend class RoadLine;
    const RoadLine* road_ = nullptr;
    std::optional<Place> here_;  // on the lane
    VehicleState car_{};
  };
  Ahead ahead_of(const VehicleState& car) const;
  /// Whether the road itself stands between two points of the world, by its height every 4 m.
  bool hides(const glm::dvec3& eye_m, const glm::dvec3& point_m) const;

 private:
  const RoadSurface& surface() const;

  std::vector<LanePoint> lane_;
  std::filesystem::path scene_file_;
  mutable std::optional<RoadSurface> surface_;
};

/// A probe in the world; nothing for one of the picture, or of a road that the scene has not.
std::optional<MeasurePoint> placed(const Probe& probe, const VehicleState& car, const RoadLine& road);

}  // namespace phare
