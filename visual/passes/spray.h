// Spray behind vehicles (visual/spray.h): a draw of puffs each, at the end of the lit pass, over what is there. Of a
// puff each line of sight has exactly what lies on it; the light of the lamps is that in the middle of each of the
// edges of its strips, by their tables, phase function and air as of the drops that fall (precipitation.h); that of its
// own vehicle's tail lamps is that of the pixel.
//
// Error: light across a strip's height is a straight line, across its width and along the line of sight one value. Left
// out: of more than eight lamps those behind the eighth, shadows, the colours within one lamp's beam.
// Checked by tests/visual/spray_test.cpp.
#pragma once

#include <array>
#include <map>
#include <tuple>

#include "visual/lit_scene.h"
#include "visual/renderer.h"

namespace phare {

/// Has the view draw spray at the end of its lit pass; before that pass is recorded, and after fog. `water_mm`: on the
/// ground; `vehicles`: spraying_seen().
void add_spray(LitScene& scene, LitView& view, std::span<const SprayingVehicle> vehicles, double water_mm);

class Spray {
 public:
  explicit Spray(gpu::Device& device) : device_(device) {}
  /// Inside a pass that has begun rendering cd/m² and set its area, after all surfaces.
  void draw(gpu::Recorder& commands, const LitScene& scene, const LitView& view, vk::Format format,
            vk::SampleCountFlagBits samples);

 private:
  /// Tables (LitScene::key_for), lamps.
  using Key = std::tuple<std::size_t, std::uint32_t, vk::Format, vk::SampleCountFlagBits>;
  vk::Pipeline pipeline(const LitScene& scene, const Key& key);

  gpu::Device& device_;
  vk::raii::PipelineLayout layout_{nullptr};  ///< made with the first pipeline
  vk::raii::ShaderModule fragment_{nullptr};
  std::map<Key, vk::raii::Pipeline> pipelines_;
};

}  // namespace phare
