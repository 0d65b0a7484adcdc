// The sky behind everything: a clear colour below the horizon, a dome of vertex colours above it, drawn first within
// the lit pass. A view that sees no sky draws none.
#pragma once

#include <glm/vec4.hpp>
#include <map>
#include <tuple>

#include "visual/gpu/frame_graph.h"
#include "visual/passes/pipeline.h"
#include "visual/view.h"

namespace phare {

enum class LampOutput : std::uint32_t;

/// Of one view.
struct Sky {
  glm::vec3 exposure_per_cdm2{1.0f};
  double zenith_cdm2 = 0.0;

  /// rgb cd/m² at the zenith, bluish; w: factor at the horizon, 3. A clear night far from towns, brightened enough to
  /// be seen on a display; chosen by eye.
  glm::vec4 zenith() const;
};

class SkyPass {
 public:
  explicit SkyPass(gpu::Device& device);

  /// What the colour target is cleared to: the sky at the horizon (and below it, where no ground is).
  static vk::ClearValue clear_value(const Sky& sky, LampOutput output, const ViewGeometry& view);

  /// The dome, inside a pass that has begun rendering and set its area. Nothing if the view sees no sky.
  void draw(gpu::Recorder& commands, const Sky& sky, const ViewGeometry& view, LampOutput output, vk::Format format,
            vk::SampleCountFlagBits samples);

 private:
  gpu::Device& device_;
  vk::raii::PipelineLayout layout_{nullptr};
  vk::raii::ShaderModule vertex_, fragment_;
  std::map<std::tuple<LampOutput, vk::Format, vk::SampleCountFlagBits>, vk::raii::Pipeline> pipelines_;
};

}  // namespace phare
