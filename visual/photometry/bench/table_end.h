// Where the table of a mounted lamp ends on the road before the car: beyond it the picture is dark, because the file
// says nothing there, not because the lamp does.
// Computes: the lowest elevation and the farthest azimuth of a table's data, met with the flat road below the car; the
// lux just inside. Leaves out: hills, the car's own body, cameras other than the driver's.
// Checked by tests/photometry/mounted_lamp_test.cpp.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "config/rig.h"
#include "visual/photometry/beam/lamp_tables.h"

namespace phare {

/// A table's rim on the road, in light and in the picture.
struct TableEnd {
  bool below = false;                      ///< the table ends downwards: the near road is outside it
  double v_deg = 0.0;                      ///< there, elevation in the lamp's own frame
  double nearest_road_m = 0.0;             ///< ahead of the lamp; what is nearer is outside
  bool sideways = false;                   ///< the table ends to the left or right
  double left_deg = 0.0, right_deg = 0.0;  ///< then: azimuths in the lamp's own frame, right positive
  double brightest_lx = 0.0;               ///< on the road just inside the rim
  /// "table ends at V -15.0°: the road nearer than 2.5 m ahead is outside it"
  std::string text() const;
};

/// Rims on the road of one table, mounted at `position_m` (car frame) and seen by one of the channels; nothing where
/// the light has faded before (below 0.1 lx, chosen: a hundredth of what a low beam lays on the near road), or where it
/// lies outside their pictures.
std::optional<TableEnd> table_end(const IntensityTable& table, const glm::dmat3& car_from_lamp, double scale,
                                  const glm::dvec3& position_m, std::span<const ChannelConfig> channels);

/// The same for every source of a rig, as it is aimed. Sources that say the same are told once.
struct SourceEnd {
  std::string design, lamp, file;
  LampFunction function = LampFunction::kLow;
  TableEnd end;
  std::string text() const;  ///< "low beam my.ies: table ends at …"
};
std::vector<SourceEnd> table_ends(const std::vector<DesignConfig>& designs, const LampTables& tables,
                                  std::span<const ChannelConfig> channels);

}  // namespace phare
