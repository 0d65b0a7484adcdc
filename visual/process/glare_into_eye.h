// Everything that shines into the eye of a view: what a frame of the drive, --explain and --cost have alike.
#pragma once

#include <span>
#include <vector>

#include "visual/fixed_light.h"
#include "visual/process/lamps.h"
#include "visual/process/traffic.h"
#include "visual/renderer.h"

namespace phare {

/// Where all of it is at that moment.
struct ShiningAround {
  const VehicleState& car;
  const Traffic& traffic;
  std::span<const Traffic::There> users;
  const FixedLight& fixed;
  const World& world;  ///< with what moves where it is
};

/// The car's own lamps as given, those of others, and the scene's where the view has not switched them off. None with
/// parallel rays: that is no eye.
std::vector<GlaringLamp> glare_into_eye(const ViewInput& view, const Lamps& lamps, const ShiningAround& around);

}  // namespace phare
