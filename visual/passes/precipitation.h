// Drops and flakes near the eye, one by one, in the light of the lamps (visual/photometry/table/precipitation.h has how
// many there are, how they fall and what they scatter). Each is a line as long as its way past the eye while that sums
// light, as bright as what it sends; what is drawn is left out of the light that fog.h's grid scatters, so that both
// together are what falls. Nothing is stored: where a drop is follows from its number and the time.
//
// Error: a line is a pixel wide; light is taken in the middle of a streak. Left out: shadows of what stands in the
// light, wind, drops nearer than a metre to the eye, where the car is, and the colours within one lamp's beam.
// Checked by tests/visual/precipitation_test.cpp.
#pragma once

#include <array>
#include <map>
#include <tuple>

#include "visual/lit_scene.h"
#include "visual/renderer.h"

namespace phare {

/// Has the view draw drops at the end of its lit pass; before that pass is recorded, and after fog.
void add_drops(LitScene& scene, LitView& view, const ViewInput& input);

class Drops {
 public:
  explicit Drops(gpu::Device& device) : device_(device) {}
  /// Inside a pass that has begun rendering cd/m² and set its area, after everything else.
  void draw(gpu::Recorder& commands, const LitScene& scene, const LitView& view, const vk::Rect2D& area,
            vk::Format format, vk::SampleCountFlagBits samples);

 private:
  /// Tables (LitScene::key_for), lamps, snow.
  using Key = std::tuple<std::size_t, std::uint32_t, bool, vk::Format, vk::SampleCountFlagBits>;
  vk::Pipeline pipeline(const LitScene& scene, const Key& key);

  gpu::Device& device_;
  vk::raii::PipelineLayout layout_{nullptr};  ///< made with the first pipeline
  vk::raii::ShaderModule fragment_{nullptr};
  std::map<Key, vk::raii::Pipeline> pipelines_;
};

}  // namespace phare
