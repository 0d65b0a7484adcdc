#include "visual/beam_store.h"

#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

namespace phare {

namespace {

constexpr std::size_t kGuideEntry = sizeof(glm::vec4);

// Writes rows of texels of a part into a buffer of `row` texels a row. Waits.
void fill_texels(gpu::Device& device, const gpu::DeviceBuffer& buffer, std::span<const std::byte> bytes,
                 const TexelRect& part, std::size_t row, std::size_t bytes_each) {
  const gpu::HostBuffer staging(device, bytes.size(), vk::BufferUsageFlagBits::eTransferSrc, "beam staging");
  std::memcpy(staging.data, bytes.data(), bytes.size());
  const std::size_t row_bytes = (part.end_column - part.column) * bytes_each;
  std::vector<vk::BufferCopy> copies;
  for (std::size_t j = part.row; j < part.end_row; ++j)
    copies.push_back({.srcOffset = (j - part.row) * row_bytes,
                      .dstOffset = (j * row + part.column) * bytes_each,
                      .size = row_bytes});
  device.run_once([&](vk::CommandBuffer commands) {
    commands.copyBuffer(*staging.buffer, *buffer.buffer, copies);
    const vk::MemoryBarrier2 read{.srcStageMask = vk::PipelineStageFlagBits2::eCopy,
                                  .srcAccessMask = vk::AccessFlagBits2::eTransferWrite,
                                  .dstStageMask = vk::PipelineStageFlagBits2::eFragmentShader,
                                  .dstAccessMask = vk::AccessFlagBits2::eShaderSampledRead};
    commands.pipelineBarrier2(vk::DependencyInfo{.memoryBarrierCount = 1, .pMemoryBarriers = &read});
  });
}

}  // namespace

BeamStore::BeamStore(gpu::Device& device) : device_(device) {
  fit(nothing_, vk::Format::eR32G32B32A32Sfloat, 1, kGuideEntry, "no beam");
  const std::array<std::byte, kGuideEntry> dark{};
  fill_texels(device, nothing_.buffer, dark, {0, 0, 1, 1}, 1, dark.size());
  no_image_ = gpu::Image(device, vk::Format::eR16Sfloat, {1, 1},
                         vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst, "no beam");
  gpu::fill_image(device, no_image_, std::span(dark).first(2));
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
    beam.fresh |= part.texels() == beam.packed.candela.size();
    if (!part.empty()) beam.changed.push_back(part);
  }
}

// Makes the buffer anew if it has another size or format.
bool BeamStore::fit(Texels& texels, vk::Format format, std::size_t count, std::size_t bytes_each, const char* name) {
  if (texels.format == format && texels.buffer.bytes == count * bytes_each) return false;
  const std::uint32_t most = device_.properties.limits.maxTexelBufferElements;
  if (count > most)
    throw std::runtime_error("the device's texel buffers hold " + std::to_string(most) + " texels, and a " + name +
                             " takes " + std::to_string(count));
  texels = {};  // first, so that both never take memory at once
  texels.buffer = gpu::DeviceBuffer(device_, count * bytes_each, vk::BufferUsageFlagBits::eUniformTexelBuffer, name);
  texels.view = vk::raii::BufferView(
      device_.device,
      vk::BufferViewCreateInfo{.buffer = *texels.buffer.buffer, .format = format, .range = VK_WHOLE_SIZE});
  texels.format = format;
  return true;
}

bool BeamStore::fit(gpu::Image& image, vk::Format format, const PackedBeam& packed, const char* name) {
  const vk::Extent2D extent{packed.columns, packed.rows_of_candela};
  if (*image.image && image.extent == extent && image.format == format) return false;
  image = gpu::Image(device_, format, extent, vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst,
                     name);
  return true;
}

// What the beam needs on the device; true when something was made anew.
bool BeamStore::fit_all(Beam& beam) {
  const PackedBeam& packed = beam.packed;
  const bool wide = packed.level == ImageLevel::kFloatNodes;
  if (packed.filtered()) {
    const auto format = packed.level == ImageLevel::kNormalised8 ? vk::Format::eR8Unorm : vk::Format::eR16Sfloat;
    bool made = fit(beam.filtered, format, packed, "beam candela");
    if (packed.tinted()) made |= fit(beam.filtered_tint, vk::Format::eR16G16Sfloat, packed, "beam colour");
    return made;
  }
  const auto format = wide ? vk::Format::eR32G32B32A32Sfloat : vk::Format::eR16G16B16A16Sfloat;
  bool made = fit(beam.cells, format, packed.texels(), packed.bytes_per_texel(), "beam table");
  if (packed.guided())
    made |= fit(beam.guide, vk::Format::eR32G32B32A32Sfloat, packed.guide.size(), kGuideEntry, "beam guide");
  if (packed.tinted()) made |= fit(beam.tint, format, 2 * packed.texels(), packed.bytes_per_texel(), "beam colour");
  return made;
}

void BeamStore::upload_parts(Beam& beam, std::span<const TexelRect> parts) {
  const PackedBeam& packed = beam.packed;
  const auto fill_filtered = [&](gpu::Image& image, const TexelRect& part, std::span<const std::byte> bytes) {
    const vk::BufferImageCopy copy{
        .imageSubresource = {image.aspect, 0, 0, 1},
        .imageOffset = {static_cast<std::int32_t>(part.column), static_cast<std::int32_t>(part.row), 0},
        .imageExtent = {static_cast<std::uint32_t>(part.end_column - part.column),
                        static_cast<std::uint32_t>(part.end_row - part.row), 1}};
    gpu::fill_image(device_, image, bytes, std::span(&copy, 1));
  };
  for (const TexelRect& nodes : parts) {
    const TexelRect part = texels_about(packed, nodes);
    uploaded_texels_ += part.texels();
    if (packed.filtered()) {
      fill_filtered(beam.filtered, part, texels_of(packed, part));
      if (packed.tinted()) fill_filtered(beam.filtered_tint, part, tint_texels_of(packed, part));
      continue;
    }
    const std::size_t row = packed.columns + 1, bytes_each = packed.bytes_per_texel();
    fill_texels(device_, beam.cells.buffer, texels_of(packed, part), part, row, bytes_each);
    if (packed.tinted())
      fill_texels(device_, beam.tint.buffer, tint_texels_of(packed, part), part, row, 2 * bytes_each);
  }
}

bool BeamStore::upload() {
  bool made = false;
  for (Beam& beam : beams_) {
    if (beam.packed.dark || (!beam.fresh && beam.changed.empty())) continue;
    ++uploads_;
    std::vector<TexelRect> parts = std::exchange(beam.changed, {});
    const bool made_now = fit_all(beam);
    made |= made_now;
    if (std::exchange(beam.fresh, false) || made_now) {
      parts = {{0, 0, beam.packed.columns, beam.packed.rows_of_candela}};
      if (beam.packed.guided())
        fill_texels(device_, beam.guide.buffer, std::as_bytes(std::span(beam.packed.guide)),
                    {0, 0, beam.packed.guide.size(), 1}, beam.packed.guide.size(), kGuideEntry);
    }
    upload_parts(beam, parts);
  }
  return made;
}

void BeamStore::describe(std::size_t index, shader::GpuLamp& lamp) const {
  const PackedBeam& beam = at(index).packed;
  lamp.colour = glm::vec4(beam.tinted() ? glm::vec3(beam.tint_scale()) : beam.colour, beam.scale_cd);
}

}  // namespace phare
