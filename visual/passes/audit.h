// The audit pass: position, normal and illuminance of every pixel of a view, to be computed again in float64.
#pragma once

#include "visual/lit_scene.h"

namespace phare {

struct AuditTarget {
  gpu::Image& position;  ///< relative to the eye, m; alpha: lx
  gpu::Image& normal;    ///< alpha: lamps, 0 where there is no surface
  gpu::Image& depth;
};

inline constexpr vk::Format kAuditFormat = vk::Format::eR32G32B32A32Sfloat;  ///< of position and normal

void draw_audit(gpu::FrameGraph& graph, LitScene& scene, const LitView& view, const AuditTarget& target);

}  // namespace phare
