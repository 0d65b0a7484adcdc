// A view once more, with the place, normal and illuminance of every pixel, to be computed again in float64.
#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "visual/lit_scene.h"
#include "visual/renderer.h"

namespace phare {

/// Of so many pixels that are audited one is dark: light that should be there and is not is found there alone.
inline constexpr std::size_t kDarkPixelIn = 4;

/// Which pixels of a picture are computed again, by `seed`; none where none is lit. `places`: w the illuminance, lx;
/// `normals`: w above 0 where there is a surface that lamps may light. What is no number counts as lit.
std::vector<std::size_t> audited_pixels(std::span<const glm::vec4> places, std::span<const glm::vec4> normals,
                                        std::size_t count, std::uint64_t seed);

class AuditPicture {
 public:
  /// As wide a view as a picture of this size has, in fewer pixels.
  AuditPicture(gpu::Device& device, const vk::Extent2D& picture);

  /// Makes the pipelines that it takes, where nothing is drawn yet.
  static void prepare(LitScene& scene, const ViewInput& view, const vk::Extent2D& picture);
  /// Into what is recorded; once. Of the view the camera, the lamps, what moves and the method.
  void draw(gpu::FrameGraph& graph, LitScene& scene, const ViewInput& view);
  /// `count` pixels (audited_pixels) chosen by `seed`, after the device has done it.
  std::vector<AuditSample> samples(std::size_t count, std::uint64_t seed) const;

 private:
  vk::Extent2D extent_;
  gpu::Image position_, normal_, depth_;
  gpu::HostBuffer positions_, normals_;
  glm::dvec3 eye_m_{0.0};
};

}  // namespace phare
