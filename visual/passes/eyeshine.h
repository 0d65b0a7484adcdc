// Animals' eyes in the picture (visual/eyeshine.h): a square of a few pixels for each, at the end of the lit pass,
// where nothing nearer hides it. Of it and of what is there already the brighter stays, so no luminance image is
// called for.
// Checked by tests/visual/eyeshine_test.cpp.
#pragma once

#include <map>
#include <tuple>

#include "visual/lit_scene.h"

namespace phare {

class Eyeshine {
 public:
  explicit Eyeshine(gpu::Device& device) : device_(device) {}
  /// Inside a pass that has begun rendering and set its area, after everything else.
  void draw(gpu::Recorder& commands, const LitView& view, const vk::Rect2D& area, LampOutput output, vk::Format format,
            vk::SampleCountFlagBits samples);

 private:
  using Key = std::tuple<LampOutput, vk::Format, vk::SampleCountFlagBits>;
  gpu::Device& device_;
  vk::raii::PipelineLayout layout_{nullptr};  ///< made when called for, as all here
  vk::raii::ShaderModule vertex_{nullptr}, fragment_{nullptr};
  std::map<Key, vk::raii::Pipeline> pipelines_;
};

}  // namespace phare
