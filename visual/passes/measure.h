// The measure pass: illuminance at points that are given, through the shader that draws the picture.
#pragma once

#include "visual/lit_scene.h"

namespace phare {

/// Illuminance in lx by lamps base..base+3 of the view, one pixel of `lx` for each of `count` vertices.
void measure_points(gpu::FrameGraph& graph, LitScene& scene, const LitView& view, gpu::Image& lx, vk::Buffer points,
                    std::uint32_t count, std::uint32_t lamp_base);

}  // namespace phare
