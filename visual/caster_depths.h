// What a lamp's shadow map holds, drawn by the processor: for a device that is the processor itself, which takes 0.6 µs
// for a triangle of a few texels where this takes 0.2 (docs/design.md). Pure: no device.
//
// Error: what a texel holds is within 1e-6 and 1e-5 of itself of the depth of the nearest triangle over its middle, for
// float32 adds up a row's texels and the rows (shaders allow for 5e-4, kShadowBias). An edge may lie 1/256 of a texel
// from where a device has it, which keeps corners to that (Vulkan's subPixelPrecisionBits, 8 of lavapipe).
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>

#include "visual/shadow_casters.h"

namespace phare {

/// A picture of a part of what a lamp sees, about its axis: texels in rows from the top, each from the left.
struct DepthPicture {
  std::uint32_t width = 1, height = 1;  ///< texels
  glm::dvec2 texels{1.0};               ///< to a tangent of 1, across and up
  std::uint32_t margin = 0;             ///< so many texels along each side stay as they are
  /// Nothing is read of it this far from its middle, in texels, so what shows there alone need not be drawn.
  glm::vec2 half_unread{-1e30f};

  /// It holds the middle of a texel that is read, or may do where it reaches past the lamp.
  bool shows(const CastBounds& triangle) const;
};

/// Raises each texel to the depth of the nearest triangle over its middle: shader::kShadowNear_m over the way forward.
/// What is seen from both sides lies as much farther as its depth changes over one and a half texels, so that it does
/// not shadow itself. `holes`: what has some casts as if it had none; else not at all. `depths`: width × height.
void raise_depths(const DepthPicture& picture, const CastBy& cast, bool holes, std::span<float> depths);
/// The same as on a processor that has no instructions for eight lanes.
void raise_depths_one_by_one(const DepthPicture& picture, const CastBy& cast, bool holes, std::span<float> depths);

}  // namespace phare
