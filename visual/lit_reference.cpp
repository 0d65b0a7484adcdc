// The lit scene by the method "reference": its shaders, its pipelines' layout, and the data that its draws read.
#include <array>
#include <bit>
#include <stdexcept>

#include "shaders/lamps_frag_reference.h"
#include "shaders/lamps_frag_reference_fog.h"
#include "shaders/lamps_frag_reference_shadows.h"
#include "shaders/lamps_frag_reference_shadows_fog.h"
#include "visual/lit_scene.h"
#include "visual/passes/fixed_shaders.h"
#include "visual/reference_light.h"

namespace phare {

struct LitScene::Reference {
  explicit Reference(gpu::Device& device) : light(device) {}
  ReferenceLight light;
  vk::raii::PipelineLayout layout{nullptr};
};

void LitScene::ReferenceDeleter::operator()(Reference* reference) const {
  delete reference;
}

void LitScene::keep_image(std::size_t beam, const BeamImage& image, std::span<const TexelRect> changed) {
  if (!device_.float64) return;
  if (images_.size() <= beam) images_.resize(beam + 1);
  BeamImage& kept = images_[beam];
  if (changed.empty() || kept.candela.size() != image.candela.size() || kept.tints.size() != image.tints.size()) {
    kept = image;
    return;
  }
  kept.dark = image.dark;
  const std::size_t columns = image.first_deg.size();
  for (const TexelRect& rect : changed)
    for (std::size_t row = rect.row; row < rect.end_row; ++row)
      for (std::size_t at = row * columns + rect.column; at < row * columns + rect.end_column; ++at) {
        kept.candela[at] = image.candela[at];
        if (!image.tints.empty()) kept.tints[at] = image.tints[at];
      }
}

LitScene::Reference& LitScene::reference() {
  if (!reference_) {
    if (const auto reason = no_reference(device_)) throw std::runtime_error("method reference: " + *reason);
    reference_.reset(new Reference(device_));
    const std::array layouts{sets_.layout(), shadow_sets_.layout(), fog_sets_.layout(), reference_->light.layout()};
    reference_->layout = pipeline_layout(layouts);
  }
  if (!reference_begun_) {
    images_.resize(beam_versions_.size());
    device_.wait_for_frames();  // its buffers are written in place
    reference_->light.begin_frame(images_, beam_versions_, geometry_);
    reference_begun_ = true;
  }
  return *reference_;
}

void LitScene::set_reference_points(std::span<const double> points) {
  reference().light.set_points(points);
}

vk::DescriptorSetLayout LitScene::reference_layout() {
  return reference().light.layout();
}

LitScene::FragmentStage LitScene::reference_stage(const LitVariant& variant) {
  static const std::array<Code, 4> codes{k_lamps_frag_reference, k_lamps_frag_reference_shadows,
                                         k_lamps_frag_reference_fog, k_lamps_frag_reference_shadows_fog};
  const Reference& own = reference();
  const bool shadows = variant.shadow_maps != 0, fog = variant.fog.slices != 0;
  if (variant.fixed_light) return {fixed_frag_reference(shadows, fog), *own.layout};
  return {codes[(shadows ? 1u : 0u) + (fog ? 2u : 0u)], *own.layout};
}

void LitScene::bind_reference(gpu::Recorder& commands, const LitView& view, const LitBy& lit_by) {
  Reference& own = reference();
  const ReferenceLight::Place place = own.light.fill(view, lit_by);
  commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *own.layout, shader::kReferenceSet, place.set,
                              place.at);
}

shader::GpuDraw reference_draw(const DrawItem& item) {
  shader::GpuDraw draw = item.push;
  draw.origin.w = std::bit_cast<float>(item.first_index);
  draw.detail_origin.w = std::bit_cast<float>(item.batch->first_vertex);
  return draw;
}

}  // namespace phare
