// The beam images on the device, of any number of lamps and designs: uploaded when they change, and then only the part
// that did.
#pragma once

#include <span>
#include <vector>

#include "visual/beam_packing.h"
#include "visual/gpu/frame_graph.h"
#include "visual/gpu/staging.h"

namespace phare {

class BeamStore {
 public:
  explicit BeamStore(gpu::Device& device);

  void set(std::size_t index, const BeamImage& image, ImageLevel level);
  /// The image set last, changed in these rectangles of its nodes only.
  void change(std::size_t index, const BeamImage& image, std::span<const TexelRect> changed);
  /// One that was never set is dark.
  const PackedBeam& beam(std::size_t index) const { return at(index).packed; }
  /// Uploads what changed, in a pass of the frame that is being recorded. True when buffers or images are new ones and
  /// descriptors have to follow.
  bool upload(gpu::FrameGraph& graph);
  /// Fills the table fields of a lamp with beam `index`.
  void describe(std::size_t index, shader::GpuLamp& lamp) const;

  /// Texel buffers: cells of the table, its guide, the cells of its colour; each a single dark texel where there is
  /// none.
  vk::BufferView cells(std::size_t index) const { return view_of(at(index).cells); }
  vk::BufferView guide(std::size_t index) const { return view_of(at(index).guide); }
  vk::BufferView tint(std::size_t index) const { return view_of(at(index).tint); }
  /// Images of the levels that the texture filter weighs.
  const gpu::Image& filtered(std::size_t index) const { return image_of(at(index).filtered); }
  const gpu::Image& filtered_tint(std::size_t index) const { return image_of(at(index).filtered_tint); }
  /// Since the start.
  std::uint64_t uploads() const { return uploads_; }
  std::uint64_t uploaded_texels() const { return uploaded_texels_; }

 private:
  struct Texels {
    gpu::DeviceBuffer buffer;
    vk::raii::BufferView view{nullptr};
    vk::Format format = vk::Format::eUndefined;
  };
  struct Beam {
    PackedBeam packed;
    Texels cells, guide, tint;
    gpu::Image filtered, filtered_tint;
    std::vector<TexelRect> changed;  ///< nodes
    bool fresh = false;              ///< all of it changed, the guide too
  };
  const Beam& at(std::size_t index) const { return index < beams_.size() ? beams_[index] : never_set_; }
  vk::BufferView view_of(const Texels& texels) const { return *texels.view ? *texels.view : *nothing_.view; }
  const gpu::Image& image_of(const gpu::Image& image) const { return *image.image ? image : no_image_; }
  bool fit(Texels& texels, vk::Format format, std::size_t count, std::size_t bytes_each, const char* name);
  bool fit(gpu::Image& image, vk::Format format, const PackedBeam& packed, const char* name);
  bool fit_all(Beam& beam);
  void fill(vk::CommandBuffer commands, const gpu::DeviceBuffer& buffer, std::span<const std::byte> bytes,
            const TexelRect& part, std::size_t row, std::size_t bytes_each);
  void fill(vk::CommandBuffer commands, gpu::Image& image, std::span<const std::byte> bytes, const TexelRect& part);
  void upload_parts(vk::CommandBuffer commands, Beam& beam, const std::vector<TexelRect>& parts);
  void upload(vk::CommandBuffer commands, Beam& beam, bool whole);

  gpu::Device& device_;
  gpu::PerFrame<gpu::Staging> staging_{device_};
  std::vector<Beam> beams_;
  Beam never_set_;
  Texels nothing_;  ///< what descriptors name that nobody reads
  gpu::Image no_image_;
  std::uint64_t uploads_ = 0, uploaded_texels_ = 0;
};

}  // namespace phare
