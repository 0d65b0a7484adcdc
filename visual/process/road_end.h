// Where the road of a scene ends, so that a driver is told and does not wonder at the dark. Pure:
// tests/visual_process/road_end_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "config/road/lane.h"
#include "net/messages.h"
#include "visual/scene/scene.h"

namespace phare {

/// On the road or beside it; past the first or last point of the scene's lane; beyond everything that the scene has.
enum class RoadPlace { kThere, kPastEnd, kNoGround };

class RoadEnd {
 public:
  /// `scene` must outlive it. `lane`: that of the scene, empty where it has none; one that comes back to its beginning
  /// has no end.
  RoadEnd(const Scene& scene, std::vector<LanePoint> lane);

  /// Of the car's origin. A scene without nodes whose names begin with road or ground has no ground to leave.
  RoadPlace of(const VehicleState& car) const;

 private:
  bool past_end(const VehicleState& car) const;

  const Scene& scene_;
  std::vector<LanePoint> lane_;
  bool has_ground_ = false;
};

/// What the driver is told; empty on the road.
std::string road_end_line(RoadPlace place);

}  // namespace phare
