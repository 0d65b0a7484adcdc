// The beam images on the device, of any number of lamps and designs: uploaded when they change, and then only the part
// that did.
#pragma once

#include <span>
#include <vector>

#include "visual/beam_packing.h"
#include "visual/gpu/device.h"

namespace phare {

class BeamStore {
 public:
  explicit BeamStore(gpu::Device& device);

  void set(std::size_t index, const BeamImage& image, ImageLevel level);
  /// The image set last, changed in these rectangles of its nodes only.
  void change(std::size_t index, const BeamImage& image, std::span<const TexelRect> changed);
  /// One that was never set is dark.
  const PackedBeam& beam(std::size_t index) const { return at(index).packed; }
  /// Uploads what changed. True when images are new ones and descriptors have to follow.
  bool upload();
  /// Fills the table fields of a lamp with beam `index`.
  void describe(std::size_t index, shader::GpuLamp& lamp) const;

  const gpu::Image& candela(std::size_t index) const { return *at(index).candela.image ? at(index).candela : nothing_; }
  const gpu::Image& guide(std::size_t index) const { return *at(index).guide.image ? at(index).guide : nothing_; }
  /// Of its colour; a lamp whose light has one colour has none.
  const gpu::Image& tint(std::size_t index) const {
    return at(index).packed.tinted() && *at(index).tint.image ? at(index).tint : nothing_;
  }
  /// Since the start.
  std::uint64_t uploads() const { return uploads_; }
  std::uint64_t uploaded_texels() const { return uploaded_texels_; }

 private:
  struct Beam {
    PackedBeam packed;
    gpu::Image candela;  ///< R32F, R16F or R8, by level
    gpu::Image guide;    ///< RGBA32F
    gpu::Image tint;     ///< RG32F, RG16F; made when first called for
    std::vector<TexelRect> changed;
    bool tint_shown = false;
    bool fresh = false;  ///< all of it changed, the guide too
  };
  const Beam& at(std::size_t index) const { return index < beams_.size() ? beams_[index] : never_set_; }
  bool fit(gpu::Image& image, vk::Format format, std::uint32_t width, std::uint32_t height, const char* name);
  void upload_parts(Beam& beam);
  void upload_tints(Beam& beam);

  gpu::Device& device_;
  std::vector<Beam> beams_;
  Beam never_set_;
  gpu::Image nothing_;  ///< what descriptors of lamps that are not there name
  std::uint64_t uploads_ = 0, uploaded_texels_ = 0;
};

}  // namespace phare
