// Shadows of what stands in the light of a view's lamps: a map of depths for each lamp that something stands before,
// rendered once a view and read where the view is lit (shaders/lib/shadow.glsl).
//
// Where the device is the processor our own code draws the maps (visual/caster_depths.h), but for those with holes.
//
// While lamps, eye and all in their light stand still, maps are kept from frame to frame (visual/kept_casters.h).
//
// Maps hold the far sides of things (visual/shadow_casters.h), on a plane across the lamp's axis that is fitted to
// them. Error: an edge is off by half a texel, seen from the lamp; levels differ in texels. Left out: what is more than
// 75° beside the lamp's axis, 45° above or below it (75° of beams with light there) or farther than 300 m from it, what
// hides faint light alone (kFaintShown), and the size of the lamp. The finest levels have no maps:
// visual/passes/shadow_rays.h.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "visual/gpu/frame_graph.h"
#include "visual/lit_scene.h"
#include "visual/passes/shadow_rays.h"

namespace phare {

/// In the order of the effect's levels (visual/effects.h), the first being off: of each of the two pictures of a map; of
/// rays one to the lamp's middle, or shader::kLensRays over its opening.
inline constexpr std::array<ShadowLevel, kShadowNames.size()> kShadowLevels{
    {{},
     {768, 512, 1},
     {768, 512, 4},
     {1536, 1024, 4},
     {0, 0, shader::kTapsOfRays + 1},
     {0, 0, shader::kTapsOfRays + shader::kLensRays}}};
static_assert(kShadowLevels[kRayShadows].taps > shader::kTapsOfRays &&
              kShadowLevels[kRayShadows - 1].taps <= shader::kTapsOfRays);

/// A pixel's pipeline tells so many maps apart: four bits a lamp, 0 being none.
inline constexpr std::size_t kMostShadowMaps = 15;

struct ShadowLimits {
  std::uint64_t buffer_texels = 0;  ///< of a texel buffer
  std::uint32_t image_side = 0;     ///< texels
};

/// Maps of a level that a device holds; Vulkan promises 65,536 texels of a buffer only.
std::size_t most_shadow_maps(const ShadowLevel& level, const ShadowLimits& limits);
/// Of those, in one image; 0: not one.
std::size_t shadow_maps_in_image(const ShadowLevel& level, const ShadowLimits& limits);

class ShadowPass {
 public:
  explicit ShadowPass(gpu::Device& device);

  /// It holds a map of the lowest level.
  bool possible() const { return most_shadow_maps(kShadowLevels[1], limits_) > 0; }

  /// It holds the scene's triangles.
  bool rays_possible(const LitScene& scene) const {
    return holds_rays(ray_texels(scene.casters()), limits_.buffer_texels);
  }

  /// Before the views of a frame; the frame before is done. Maps that it did not call for are freed. `seen`: false of a
  /// rehearsal, for which no triangles for rays are freed.
  void begin_frame(bool seen = true);
  /// Draws the maps of the view's lamps, or places the triangles for rays, and has the view read them from here on.
  /// `in_air`: points in the air are looked up in maps, so with rays there are maps for those (LitView::air_shadows).
  void draw(gpu::FrameGraph& graph, LitScene& scene, LitView& view, std::size_t level, bool in_air = false);

  /// Corners from `first` on, drawn as one side or both are seen.
  struct Range {
    std::uint32_t first = 0, count = 0;
  };
  /// Of a material with holes.
  struct CutRange {
    std::size_t material = 0;
    Range range{};
  };
  /// Of one picture: far sides of what is seen from one side, then what is seen from both, then what has holes.
  struct Ranges {
    std::array<Range, 2> sides{};
    std::vector<CutRange> cut{};
  };

 private:
  /// Of the two of a map.
  struct Picture {
    bool close = false;     ///< the middle, larger
    glm::dvec2 scale{1.0};  ///< tangents to the picture's half sides
    Ranges ranges{};
  };

  void draw_maps(gpu::FrameGraph& graph, LitScene& scene, LitView& view, std::size_t level);
  /// Pictures of one image, one below the other, and their depths into the buffer from `first_texel` on.
  void draw_image(gpu::FrameGraph& graph, LitScene& scene, const ShadowDepths& depths, const ShadowLevel& level,
                  const std::vector<Picture>& pictures, std::size_t first_texel);
  vk::Pipeline pipeline(const LitScene& scene, bool both_sides);
  vk::Pipeline cut_pipeline(LitScene& scene);
  ShadowDepths& depths_of(std::size_t texels);

  gpu::Device& device_;
  ShadowLimits limits_;
  vk::raii::ShaderModule vertex_{nullptr};  ///< made with the first map
  std::array<vk::raii::Pipeline, 2> pipelines_{nullptr, nullptr};
  vk::raii::ShaderModule cut_vertex_{nullptr}, cut_fragment_{nullptr};  ///< made with the first that has holes
  vk::raii::Pipeline cut_pipeline_{nullptr};
  std::vector<std::unique_ptr<ShadowDepths>> depths_;  ///< of each view with shadows
  std::size_t used_ = 0;                               ///< of them, by this frame
  std::unique_ptr<ShadowRays> rays_;                   ///< made when a frame first calls for it
};

}  // namespace phare
