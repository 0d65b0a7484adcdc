// Drops on the windscreen (visual/windscreen.h) over a view's luminance image: first the light of each from the picture
// about it, into a small image, then a disc for each that is there. Illuminance in the image's alpha stays.
// Checked by tests/visual/windscreen_test.cpp.
#pragma once

#include "visual/gpu/descriptor_sets.h"
#include "visual/picture_effect.h"

namespace phare {

class WindscreenPass final : public PictureEffect {
 public:
  explicit WindscreenPass(gpu::Device& device);

  void begin_frame() override;
  void draw(const PictureDraw& at) override;

 private:
  vk::DescriptorSet reads(const gpu::Image& image);

  gpu::Device& device_;
  gpu::DescriptorSets sets_;
  vk::raii::PipelineLayout light_layout_{nullptr}, layout_{nullptr};
  vk::raii::Sampler sampler_{nullptr};
  vk::raii::Pipeline light_{nullptr}, drops_{nullptr};
};

}  // namespace phare
