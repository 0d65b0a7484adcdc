// A scene on the device, and which of its chunks a view has to draw.
#pragma once

#include <vector>

#include "shaders/lamps.h"
#include "visual/gpu/device.h"
#include "visual/renderer.h"
#include "visual/scene/scene.h"

namespace phare {

/// One chunk to draw, ready for its push constants.
struct DrawItem {
  const SceneChunk* chunk = nullptr;
  shader::GpuDraw push{};
  float distance_m = 0.0f;
};

struct SceneBuffers {
  std::vector<SceneMaterial> materials;
  std::vector<SceneChunk> chunks;
  gpu::DeviceBuffer vertices, indices, material_buffer;

  SceneBuffers() = default;
  SceneBuffers(gpu::Device& device, const Scene& scene);

  /// Chunks whose bounds touch the view, those of one kind of material together, near ones first.
  std::vector<DrawItem> visible(const Camera& camera, double aspect) const;
};

}  // namespace phare
