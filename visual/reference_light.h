// What the method "reference" reads beside the picture's own data: lamps, tables, triangles and points in float64
// (shaders/reference.h), as storage buffers in a descriptor set of their own. Made when a view first calls for it.
// Left out: candela are those of the beam image, float32. Checked by tests/visual/reference_method_test.cpp.
#pragma once

#include <glm/mat3x3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "shaders/reference.h"
#include "visual/gpu/descriptor_sets.h"
#include "visual/photometry/beam/beam_image.h"

namespace phare {

struct LitBy;
struct LitView;
struct SceneBuffers;

/// Why this device cannot draw by the method "reference"; nothing: it can.
std::optional<std::string> no_reference(const gpu::Device& device);

/// Of an image as the shader reads it, in the order of shaders/reference.h. A dark one: no words.
std::vector<double> reference_table(const BeamImage& image);

class ReferenceLight {
 public:
  /// On a device for which no_reference() says nothing.
  explicit ReferenceLight(gpu::Device& device);

  vk::DescriptorSetLayout layout() const { return sets_.layout(); }
  /// The frame before is done. `versions`: of each image, another number with each change.
  void begin_frame(std::span<const BeamImage> images, std::span<const std::uint64_t> versions,
                   const SceneBuffers& geometry);
  /// Points to be measured in this frame, relative to the eye, m, and unit normals: of a place six numbers.
  void set_points(std::span<const double> points);

  /// The lamps of one of the view's sets, and the view: the set that holds them and where in it.
  struct Place {
    vk::DescriptorSet set;
    std::uint32_t at = 0;  ///< dynamic offset, bytes
  };
  Place fill(const LitView& view, const LitBy& lit_by);

 private:
  static constexpr std::size_t kPlacesInPage = 16;
  struct Page {
    gpu::HostBuffer words;
    vk::DescriptorSet set;
  };
  void upload_tables(std::span<const BeamImage> images);
  void point_to_buffers(const Page& page);

  gpu::Device& device_;
  gpu::DescriptorSets sets_;
  gpu::HostBuffer tables_, points_;
  vk::Buffer vertices_, indices_;
  std::vector<std::size_t> table_at_;  ///< words before each beam's
  std::vector<glm::dmat3> rows_;       ///< of each beam: the axes of its image that the rows a, b, c are
  std::vector<std::uint64_t> versions_;
  std::vector<Page> pages_;
  std::size_t used_ = 0;  ///< places of this frame
};

}  // namespace phare
