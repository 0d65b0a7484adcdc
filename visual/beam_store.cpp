#include "visual/beam_store.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <utility>

namespace phare {

namespace {

constexpr std::size_t kGuideEntry = sizeof(glm::vec4);

// Rectangles that touch become one, so that no texel is copied twice: copies of one pass have no order.
std::vector<TexelRect> apart(std::vector<TexelRect> rects) {
  for (bool joined = true; joined;) {
    joined = false;
    for (std::size_t i = 0; i < rects.size() && !joined; ++i)
      for (std::size_t j = i + 1; j < rects.size() && !joined; ++j) {
        TexelRect &a = rects[i], &b = rects[j];
        joined = a.column < b.end_column && b.column < a.end_column && a.row < b.end_row && b.row < a.end_row;
        if (!joined) continue;
        a = {std::min(a.column, b.column), std::min(a.row, b.row), std::max(a.end_column, b.end_column),
             std::max(a.end_row, b.end_row)};
        rects.erase(rects.begin() + static_cast<std::ptrdiff_t>(j));
      }
  }
  return rects;
}

void order(vk::CommandBuffer commands, vk::PipelineStageFlags2 before, vk::AccessFlags2 did,
           vk::PipelineStageFlags2 after, vk::AccessFlags2 will) {
  const vk::MemoryBarrier2 barrier{
      .srcStageMask = before, .srcAccessMask = did, .dstStageMask = after, .dstAccessMask = will};
  commands.pipelineBarrier2(vk::DependencyInfo{.memoryBarrierCount = 1, .pMemoryBarriers = &barrier});
}

}  // namespace

BeamStore::BeamStore(gpu::Device& device) : device_(device) {
  fit(nothing_, vk::Format::eR32G32B32A32Sfloat, 1, kGuideEntry, "no beam");
  no_image_ = gpu::Image(device, vk::Format::eR16Sfloat, {1, 1},
                         vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst, "no beam");
  const std::array<std::byte, kGuideEntry> dark{};
  device.run_once([&](vk::CommandBuffer commands) {
    fill(commands, nothing_.buffer, dark, {0, 0, 1, 1}, 1, dark.size());
    fill(commands, no_image_, std::span(dark).first(2), {0, 0, 1, 1});
  });
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
  if (*texels.view) device_.wait_for_frames();
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
  if (*image.image) device_.wait_for_frames();
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

// Rows of texels of a part, in a buffer of `row` texels a row.
void BeamStore::fill(vk::CommandBuffer commands, const gpu::DeviceBuffer& buffer, std::span<const std::byte> bytes,
                     const TexelRect& part, std::size_t row, std::size_t bytes_each) {
  const gpu::Staging::Place from = staging_->put(device_, bytes);
  const std::size_t row_bytes = (part.end_column - part.column) * bytes_each;
  std::vector<vk::BufferCopy> copies;
  for (std::size_t j = part.row; j < part.end_row; ++j)
    copies.push_back({.srcOffset = from.offset + (j - part.row) * row_bytes,
                      .dstOffset = (j * row + part.column) * bytes_each,
                      .size = row_bytes});
  commands.copyBuffer(from.buffer, *buffer.buffer, copies);
}

void BeamStore::fill(vk::CommandBuffer commands, gpu::Image& image, std::span<const std::byte> bytes,
                     const TexelRect& part) {
  const gpu::Staging::Place from = staging_->put(device_, bytes);
  const vk::BufferImageCopy copy{
      .bufferOffset = from.offset,
      .imageSubresource = {image.aspect, 0, 0, 1},
      .imageOffset = {static_cast<std::int32_t>(part.column), static_cast<std::int32_t>(part.row), 0},
      .imageExtent = {static_cast<std::uint32_t>(part.end_column - part.column),
                      static_cast<std::uint32_t>(part.end_row - part.row), 1}};
  gpu::record_fill(commands, image, from.buffer, std::span(&copy, 1));
}

void BeamStore::upload_parts(vk::CommandBuffer commands, Beam& beam, const std::vector<TexelRect>& parts) {
  const PackedBeam& packed = beam.packed;
  std::vector<TexelRect> texels;
  for (const TexelRect& nodes : parts) texels.push_back(texels_about(packed, nodes));
  for (const TexelRect& part : apart(std::move(texels))) {
    uploaded_texels_ += part.texels();
    if (packed.filtered()) {
      fill(commands, beam.filtered, texels_of(packed, part), part);
      if (packed.tinted()) fill(commands, beam.filtered_tint, tint_texels_of(packed, part), part);
      continue;
    }
    const std::size_t row = packed.columns + 1, bytes_each = packed.bytes_per_texel();
    fill(commands, beam.cells.buffer, texels_of(packed, part), part, row, bytes_each);
    if (packed.tinted()) fill(commands, beam.tint.buffer, tint_texels_of(packed, part), part, row, 2 * bytes_each);
  }
}

void BeamStore::upload(vk::CommandBuffer commands, Beam& beam, bool whole) {
  const PackedBeam& packed = beam.packed;
  std::vector<TexelRect> parts = std::exchange(beam.changed, {});
  if (whole) parts = {{0, 0, packed.columns, packed.rows_of_candela}};
  if (whole && packed.guided())
    fill(commands, beam.guide.buffer, std::as_bytes(std::span(packed.guide)), {0, 0, packed.guide.size(), 1},
         packed.guide.size(), kGuideEntry);
  upload_parts(commands, beam, parts);
}

bool BeamStore::upload(gpu::FrameGraph& graph) {
  staging_->begin_frame();
  bool made = false;
  std::vector<std::pair<Beam*, bool>> changed;  // with whether all of it did
  for (Beam& beam : beams_) {
    if (beam.packed.dark || (!beam.fresh && beam.changed.empty())) continue;
    const bool made_now = fit_all(beam);
    made |= made_now;
    changed.emplace_back(&beam, std::exchange(beam.fresh, false) || made_now);
  }
  if (changed.empty()) return false;
  uploads_ += changed.size();
  graph.copy("beams", {}, [&](gpu::Recorder& commands) {
    using Stage = vk::PipelineStageFlagBits2;
    using Access = vk::AccessFlagBits2;
    // Methods that light vertices read beams there, fog where it is computed.
    const auto readers = Stage::eVertexShader | Stage::eFragmentShader | Stage::eComputeShader;
    order(commands, readers, Access::eNone, Stage::eCopy, Access::eNone);
    for (const auto& [beam, whole] : changed) upload(commands, *beam, whole);
    order(commands, Stage::eCopy, Access::eTransferWrite, readers, Access::eShaderSampledRead);
  });
  return made;
}

void BeamStore::describe(std::size_t index, shader::GpuLamp& lamp) const {
  const PackedBeam& beam = at(index).packed;
  lamp.colour = glm::vec4(beam.tinted() ? glm::vec3(beam.tint_scale()) : beam.colour, beam.scale_cd);
}

}  // namespace phare
