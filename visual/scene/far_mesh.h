// A chunk as it is drawn from afar, with fewer triangles. A level of detail: the whole mesh is the truth; the frame
// benchmark says what these save.
#pragma once

#include <array>
#include <vector>

#include "visual/scene/scene.h"

namespace phare {

struct FarLevel {
  double from;                    ///< multiple of FrameInput::far_mesh_from_m
  double leaf_m2;                 ///< leaf triangles are thinned, and the rest grown to the area of all, up to so large
  std::uint32_t leaves_per_leaf;  ///< of so many at most one stays
};
inline constexpr std::array<FarLevel, 7> kFarLevels{
    {{0.3, 0.25, 2}, {0.4, 0.6, 5}, {0.63, 1.0, 9}, {1.0, 1.6, 14}, {1.7, 3.2, 24}, {2.5, 5.6, 48}, {4.5, 9.6, 96}}};
/// Of kFarLevels the first that changes anything but leaves.
inline constexpr std::size_t kFirstFarOfThings = 1;
/// Of kFarLevels the first that changes a chunk of this material.
inline std::size_t first_far_level(const SceneMaterial& material) {
  return material.surface == Surface::kFoliage ? 0 : kFirstFarOfThings;
}
/// Errors in the place of corners, as angles from the level's beginning. A pixel of 1280 across 60° is 0.8 mrad.
constexpr double kFarGroundError_rad = 0.2e-3;  ///< road and ground, which a crest shows edge on
constexpr double kFarThingError_rad = 0.75e-3;  ///< things beside the road
/// Of these, what is narrower is left out: less than a pixel wide, it comes and goes from pixel to pixel.
constexpr double kFarThingWidth_rad = 0.8e-3;
/// Closed lumps within crowns, whose outline is their leaves'.
constexpr double kFarLumpError_rad = 1.9e-3;

struct FarMesh {
  std::vector<SceneVertex> vertices;  ///< relative to the chunk's origin
  std::vector<std::uint32_t> indices;
  std::vector<CornerLook> looks{};  ///< one for each vertex, where the chunk has them
};

/// Ground and things are simplified by quadric error (Garland and Heckbert 1997) by meshoptimizer, ground but for its
/// sides; so are closed lumps of foliage that are seen from one side, and leaves are thinned; retroreflectors and
/// markings stay whole, and paint but at the last level, for what is seen of them far away is their exact place.
/// `from_m`: the nearest distance this mesh is drawn at.
FarMesh far_mesh(const Scene& scene, const SceneChunk& chunk, std::size_t level, double from_m);

}  // namespace phare
