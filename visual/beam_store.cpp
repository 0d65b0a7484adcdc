#include "visual/beam_store.h"

#include <utility>

namespace phare {

namespace {

vk::Format format_of(ImageLevel level) {
  switch (level) {
    case ImageLevel::kNormalised8:
      return vk::Format::eR8Unorm;
    case ImageLevel::kHalfEven:
    case ImageLevel::kHalfNodes:
      return vk::Format::eR16Sfloat;
    case ImageLevel::kFloatNodes:
      break;
  }
  return vk::Format::eR32Sfloat;
}

}  // namespace

BeamStore::BeamStore(gpu::Device& device) : device_(device) {
  nothing_ = gpu::Image(device, vk::Format::eR32Sfloat, {1, 1},
                        vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst, "no beam");
  const float dark = 0.0f;
  gpu::fill_image(device, nothing_, std::as_bytes(std::span(&dark, 1)));
}

void BeamStore::set(std::size_t index, const BeamImage& image, ImageLevel level) {
  if (index >= beams_.size()) beams_.resize(index + 1);
  Beam& beam = beams_[index];
  beam.packed = pack_beam(image, level);
  beam.changed.clear();
  beam.fresh = true;
}

void BeamStore::change(std::size_t index, const BeamImage& image, std::span<const TexelRect> changed) {
  Beam& beam = beams_.at(index);
  for (const TexelRect& rect : changed) {
    const TexelRect part = pack_again(beam.packed, image, rect);
    beam.fresh |= part.end_column == beam.packed.columns && part.end_row == beam.packed.rows_of_candela;
    if (!part.empty()) beam.changed.push_back(part);
  }
}

// Makes the image anew if it has another size or format.
bool BeamStore::fit(gpu::Image& image, vk::Format format, std::uint32_t width, std::uint32_t height, const char* name) {
  if (*image.image && image.extent == vk::Extent2D{width, height} && image.format == format) return false;
  image = gpu::Image(device_, format, {width, height},
                     vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst, name);
  return true;
}

void BeamStore::upload_tints(Beam& beam) {
  for (const TexelRect& part : beam.changed) {
    const vk::BufferImageCopy copy{
        .imageSubresource = {beam.tint.aspect, 0, 0, 1},
        .imageOffset = {static_cast<std::int32_t>(part.column), static_cast<std::int32_t>(part.row), 0},
        .imageExtent = {static_cast<std::uint32_t>(part.end_column - part.column),
                        static_cast<std::uint32_t>(part.end_row - part.row), 1}};
    gpu::fill_image(device_, beam.tint, tint_texels_of(beam.packed, part), std::span(&copy, 1));
  }
}

void BeamStore::upload_parts(Beam& beam) {
  std::vector<std::byte> texels;
  std::vector<vk::BufferImageCopy> copies;
  for (const TexelRect& part : std::exchange(beam.changed, {})) {
    texels.resize((texels.size() + 3) / 4 * 4);  // offsets are multiples of 4
    copies.push_back({.bufferOffset = texels.size(),
                      .imageSubresource = {beam.candela.aspect, 0, 0, 1},
                      .imageOffset = {static_cast<std::int32_t>(part.column), static_cast<std::int32_t>(part.row), 0},
                      .imageExtent = {static_cast<std::uint32_t>(part.end_column - part.column),
                                      static_cast<std::uint32_t>(part.end_row - part.row), 1}});
    const std::vector<std::byte> bytes = texels_of(beam.packed, part);
    texels.insert(texels.end(), bytes.begin(), bytes.end());
    uploaded_texels_ += part.texels();
  }
  gpu::fill_image(device_, beam.candela, texels, copies);
}

bool BeamStore::upload() {
  bool new_images = false;
  for (Beam& beam : beams_) {
    if (beam.packed.dark || (!beam.fresh && beam.changed.empty())) continue;
    ++uploads_;
    const bool all = std::exchange(beam.fresh, false) || !*beam.candela.image;
    if (all) beam.changed = {{0, 0, beam.packed.columns, beam.packed.rows_of_candela}};
    new_images |= fit(beam.candela, format_of(beam.packed.level), beam.packed.columns, beam.packed.rows_of_candela,
                      "beam candela");
    if (beam.packed.tinted()) {
      const auto format =
          beam.packed.level == ImageLevel::kFloatNodes ? vk::Format::eR32G32Sfloat : vk::Format::eR16G16Sfloat;
      new_images |= fit(beam.tint, format, beam.packed.columns, beam.packed.rows_of_candela, "beam colour");
      upload_tints(beam);
    }
    new_images |= beam.packed.tinted() != std::exchange(beam.tint_shown, beam.packed.tinted());
    upload_parts(beam);
    if (!all || !beam.packed.guided()) continue;
    const auto guide_rows = static_cast<std::uint32_t>(beam.packed.guide.size() / shader::kGuideRow);
    new_images |= fit(beam.guide, vk::Format::eR32G32B32A32Sfloat, shader::kGuideRow, guide_rows, "beam guide");
    gpu::fill_image(device_, beam.guide, std::as_bytes(std::span(beam.packed.guide)));
  }
  return new_images;
}

void BeamStore::describe(std::size_t index, shader::GpuLamp& lamp) const {
  const PackedBeam& beam = at(index).packed;
  lamp.colour = glm::vec4(beam.tinted() ? glm::vec3(beam.tint_scale()) : beam.colour, beam.scale_cd);
  lamp.position.w = beam.filtered() ? beam.scale_cd : beam.inverse_coarse;
  lamp.nodes = beam.nodes;
  lamp.coordinates = beam.coordinates;
  lamp.within = beam.within;
  lamp.range = beam.range;
  lamp.bins = beam.bins;
  lamp.guide = beam.guide_bins;
}

}  // namespace phare
