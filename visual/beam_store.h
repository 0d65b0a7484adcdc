// The beam images as the shaders read them, candela in float32. Where the nodes of both axes are multiples of a fine step near 0° and
// of a coarse one beyond, on that even grid: every node of the table is one of it, so bilinear interpolation on it is that of the table. Else on the native nodes,
// with a guide that finds the node of an angle in one fetch.
#pragma once

#include <array>
#include <vector>

#include "shaders/lamps.h"
#include "visual/gpu/device.h"
#include "visual/photometry/beam_image.h"

namespace phare {

/// One beam image packed for the GPU.
struct PackedBeam {
  std::uint32_t lookup = shader::kLookupGuide;
  std::vector<float> candela;  ///< [second][first] of the shader's angles, one column and one row of zeros after the last
  std::uint32_t columns = 0, candela_rows = 0;          ///< with the zeros
  std::vector<glm::vec4> guide;                         ///< of first, then of second; whole rows of kGuideRow
  std::uint32_t second_guide = 0;                       ///< bin where that of second begins
  float inverse_coarse = 1.0f;
  glm::vec4 nodes{0.0f}, coordinates{0.0f}, within{0.0f}, range{0.0f}, bins_per_deg{0.0f};  ///< as in shaders/lamps.h
  // Which axes of the image the shader's rows a, b, c are: columns in the image frame (forward, left, up).
  glm::dmat3 rows{1.0};
  glm::vec3 colour{1.0f};
  bool dark = true;
};

/// An even grid has at most 4096 nodes a side and 4 M in all. Guides hold at most one node a bin, so bins are as narrow as the closest
/// nodes; at most 65,536 bins: nodes closer than range/65536 make the guide inexact there by less than one such bin.
PackedBeam pack_beam(const BeamImage& image);

class BeamStore {
 public:
  explicit BeamStore(gpu::Device& device);

  void set(std::size_t index, const BeamImage& image);
  const PackedBeam& beam(std::size_t index) const { return beams_[index].packed; }
  /// Uploads the beams that changed. True when images are new ones and descriptors have to follow.
  bool upload();
  /// Fills the table fields of a lamp with beam `index`.
  void describe(std::size_t index, shader::GpuLamp& lamp) const;

  const gpu::Image& candela(std::size_t index) const { return *beams_[index].candela.image ? beams_[index].candela : nothing_; }
  const gpu::Image& guide(std::size_t index) const { return *beams_[index].guide.image ? beams_[index].guide : nothing_; }
  /// Uploads since the start.
  std::uint64_t uploads() const { return uploads_; }

 private:
  struct Beam {
    PackedBeam packed;
    gpu::Image candela;  ///< R32F
    gpu::Image guide;    ///< RGBA32F
    bool changed = false;
  };
  bool fit(gpu::Image& image, vk::Format format, std::uint32_t width, std::uint32_t height, const char* name);

  gpu::Device& device_;
  std::array<Beam, shader::kMaxLamps> beams_;
  gpu::Image nothing_;  ///< what descriptors of lamps that are not there name
  std::uint64_t uploads_ = 0;
};

}  // namespace phare
