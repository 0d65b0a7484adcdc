// The beam images as the shaders read them: native nodes, a guide that finds the node of an angle in one fetch, candela in float32.
#pragma once

#include <array>
#include <vector>

#include "shaders/lamps.h"
#include "visual/gpu/device.h"
#include "visual/photometry/beam_image.h"

namespace phare {

/// One beam image packed for the GPU.
struct PackedBeam {
  std::vector<glm::vec4> first_guide, second_guide;
  std::vector<float> candela;  ///< [second][first] of the shader's angles, padded by one row and two
  glm::vec4 range{0.0f};
  glm::vec4 bins_per_deg{0.0f};
  std::uint32_t row_length = 0;
  // Which axes of the image the shader's rows a, b, c are: columns in the image frame (forward, left, up).
  glm::dmat3 rows{1.0};
  glm::vec3 colour{1.0f};
  bool dark = true;
};

/// Guides hold at most one node a bin, so bins are as narrow as the closest nodes; at most 65,536 bins.
/// Nodes closer than range/65536 make the guide inexact there by less than one such bin.
PackedBeam pack_beam(const BeamImage& image);

class BeamStore {
 public:
  explicit BeamStore(gpu::Device& device);

  void set(std::size_t index, const BeamImage& image);
  const PackedBeam& beam(std::size_t index) const { return beams_[index]; }
  /// Uploads what changed. True when the buffers are new ones and descriptors have to follow.
  bool upload();
  /// Fills the table fields of a lamp with beam `index`.
  void describe(std::size_t index, shader::GpuLamp& lamp) const;

  vk::Buffer guides() const { return *guides_.buffer; }
  vk::Buffer candela() const { return *candela_.buffer; }

 private:
  gpu::Device& device_;
  std::array<PackedBeam, shader::kMaxLamps> beams_;
  struct Place {
    std::uint32_t first_guide = 0, second_guide = 0, candela = 0;
  };
  std::array<Place, shader::kMaxLamps> places_{};
  gpu::HostBuffer guides_, candela_;
  bool changed_ = true;
};

}  // namespace phare
