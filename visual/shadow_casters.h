// What stands in the light of a lamp: which pieces of a scene, and the part of the lamp's view that they fill, for its
// shadow map. Pure: no device.
//
// A triangle casts where its far side looks at the lamp, or both of its sides are seen: what faces the lamp is lit
// itself, and what it hides is hidden by the far side behind it too. So a road casts nothing until it falls away behind
// a crest.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "visual/light_peaks.h"
#include "visual/light_reach.h"
#include "visual/scene/ray_tree.h"
#include "visual/scene/world.h"
#include "visual/view.h"

namespace phare {

/// Nothing farther from a lamp than this casts a shadow.
inline constexpr double kShadowsTo_m = 300.0;
/// Tangents to the left or right of the lamp's axis, and above or below it, beyond which nothing casts a shadow: 75°,
/// and 45°. What stands higher beside a car is a crown in the last of its light, and would take texels from all else;
/// of a beam that has light there (LightPeaks::is_high()) it casts to 75°.
inline constexpr double kWidestShadow = 3.73, kHighestShadow = 1.0;

/// A part of what a lamp sees: tangents to the left and up, over the way forward.
struct TangentRect {
  double right = 0.0, left = 0.0, low = 0.0, high = 0.0;
  bool empty() const { return left <= right || high <= low; }
};

/// A corner of a surface with holes, and where of its texture it is.
struct CutCorner {
  glm::vec3 corner_m;
  glm::vec2 uv;
};

/// What a triangle fills of a lamp's view.
struct CastBounds {
  glm::vec2 least{0.0f}, most{0.0f};  ///< tangents to the left and up
  float nearest_m = 0.0f;             ///< along the axis
  bool beside = false;                ///< it reaches past the lamp: all of this is left open
};

/// Triangles that cast but where their texture has holes: three corners each, and bounds of each.
struct CutCasters {
  std::size_t material = 0;  ///< of the scene and then of what moves
  std::vector<CutCorner> corners{};
  std::vector<CastBounds> bounds{};
};

/// Triangles that cast: three corners each, forward, left, up from the lamp, m; and bounds of each.
struct WholeCasters {
  std::vector<glm::vec3> corners{};
  std::vector<CastBounds> bounds{};

  void reserve(std::size_t triangles) { corners.reserve(3 * triangles), bounds.reserve(triangles); }
};

/// What casts shadows in the light of one lamp.
struct CastBy {
  std::vector<bool> chunks{};  ///< of the scene and then of what moves, which of them cast; empty: none does
  std::size_t count = 0;       ///< of those
  TangentRect part{};          ///< that they fill, as far as what they hide may be seen
  /// Far sides of what is seen from one side, and all of what is seen from both.
  WholeCasters far_sides{}, both_sides{};
  std::vector<CutCasters> cut{};  ///< by material
};

/// Where a material with holes has them: opacity in 255ths, rows from the top; there is nothing where it is less than
/// `below`, between texels as the sampler has it.
struct Holes {
  std::uint32_t width = 0, height = 0;
  TextureSampler sampler{};
  float below = 0.0f;
  std::vector<std::uint8_t> opacity{};
};

/// A triangle with holes: where its first corner is of the texture, and how far from there the others are.
struct CutTriangle {
  glm::vec2 at{0.0f}, ab{0.0f}, ac{0.0f};
  std::size_t holes = 0;  ///< which of ShadowCasters::holes()
};

/// Triangles of a chunk that may cast.
struct CasterMesh {
  std::vector<glm::vec3> corners_m{};  ///< relative to the chunk's origin
  std::vector<std::uint32_t> indices{};
  std::vector<glm::vec2> uvs{};  ///< of its corners, where its material has holes
};

/// Far meshes cast from nearer than they are seen: what they are off by is then 1.25 mrad from the lamp
/// (kFarThingError_rad), half a texel of a map that reaches to the sides. Chosen: at 0.4 pictures change in three times
/// as many pixels (docs/accuracy.md).
inline constexpr double kFarCasters = 0.6;

/// So many of kFarLevels begin nearer than kShadowsTo_m from the lamp in a picture of common pixels.
inline constexpr std::size_t kFarCasterLevels = 6;

/// Of one chunk, by how far from the lamp it is: as kFarLevels has it, those that begin nearer than kShadowsTo_m; none
/// where it is the mesh before. Empty: the whole mesh everywhere.
using FarCasters = std::vector<std::optional<CasterMesh>>;

/// What of all that stands in the light is to cast.
struct CastersFor {
  /// Chunks that begin at the multiples kFarLevels of it or beyond cast by fewer triangles.
  double far_from_m = std::numeric_limits<double>::infinity();
  /// Shadows fall into this view alone; null: anywhere.
  const ViewGeometry* view = nullptr;
  /// What hides no more than so much of the lamp's light, lx facing it, casts none; 0: all that stands in it casts.
  double faint_lx = 0.0;
  const LightPeaks* peaks = nullptr;  ///< of the lamp's beam; null: it may shine anywhere
  /// What stands in the same light, found before with nothing moving: only what moves is looked for and added.
  const CastBy* standing = nullptr;
};

/// Triangles for rays. `cut` of theirs counts in `cut` here.
struct RayTrees {
  RayTree standing{};
  std::vector<RayTree> moving{};  ///< of each mesh of what moves, about its origin
  std::vector<CutTriangle> cut{};
};

class ShadowCasters {
 public:
  ShadowCasters() = default;
  /// `moving`: meshes of what moves.
  /// `far`: of each chunk of `scene`, or nothing.
  explicit ShadowCasters(const Scene& scene, const Scene& moving = {}, std::vector<FarCasters> far = {});

  /// What rays are asked against, as occluder() does (visual/scene/ray_hit.h): all triangles but paint. Copies them: for
  /// who asks for rays.
  RayTrees ray_trees() const;
  /// Of those: how many triangles, and how many of them have holes.
  std::size_t ray_triangles() const { return ray_triangles_; }
  std::size_t ray_triangles_with_holes() const { return ray_triangles_with_holes_; }
  /// The holes of each material that has some.
  const std::vector<Holes>& holes() const { return holes_; }

  /// `world_from_image`: forward, left and up of the lamp at the tip of `reach`. Reads the triangles of every chunk
  /// that is near and in the light. `moving`: where the meshes are now, all but the one that carries the lamp.
  CastBy by(const LampReach& reach, const glm::dmat3& world_from_image, std::span<const PlacedMesh> moving = {},
            std::size_t carried_by = SIZE_MAX, const CastersFor& wanted = {}) const;

 private:
  struct Chunk {
    glm::dvec3 origin_m{0.0}, low_m{0.0}, high_m{0.0};
    bool double_sided = false;
    bool paint = false;
    CasterMesh whole{};
    FarCasters far{};
    std::optional<std::size_t> cut_of{};  ///< its material has holes: which
    std::size_t holes = 0;                ///< and which of holes_

    const CasterMesh& mesh_at(double distance_m, double far_from_m) const;
  };
  Chunk chunk_of(const Scene& scene, const SceneChunk& from, std::size_t first_material);
  static void add_triangles(const Chunk& chunk, std::vector<RayTree::Triangle>& triangles,
                            std::vector<CutTriangle>& cut);
  /// Where a lamp's light goes, in the lamp's frame.
  struct Light {
    TangentRect part;
    /// Of each side of the view, its normal inward and how far along that a corner lies at most whose shadow is beyond.
    std::vector<glm::vec4> sides{};
    const LightPeaks* peaks = nullptr;  ///< with `faint_lx`, as CastersFor has them
    float faint_lx = 0.0f;

    /// All that shines between these cells of `peaks` is faint where it has come so far.
    bool faint(const glm::vec2& least_cell, const glm::vec2& most_cell, float distance_m) const {
      return peaks != nullptr && !peaks->exceeds_in(least_cell, most_cell, faint_lx * distance_m * distance_m);
    }
  };
  /// Adds the triangles of a chunk that cast; false: none does. `turn`, `shift`: from its corners into the lamp's
  /// frame; `lamp_m`: the lamp in theirs.
  static bool cast_chunk(const Chunk& chunk, const CasterMesh& mesh, const glm::mat3& turn, const glm::vec3& shift,
                         const glm::vec3& lamp_m, const Light& light, CastBy& cast);

  std::vector<Chunk> chunks_;
  std::vector<Holes> holes_;
  std::size_t ray_triangles_ = 0, ray_triangles_with_holes_ = 0;
  std::vector<std::vector<Chunk>> moving_;  ///< by mesh
};

/// In how many parts so many triangles of one lamp are worked on at once: what comes out is the same wherever it is, so
/// by their number alone.
std::size_t parts_of_casters(std::size_t triangles);

/// How many pieces of the scene cast in the light of any of them.
std::size_t casters_of_all(std::span<const std::shared_ptr<const CastBy>> casts);

/// Half the sides of a part about the axis that holds `part`: tangents across and up. In steps, so that the texels of a
/// map stay where they are while what it shows changes a little.
glm::dvec2 half_sides(const TangentRect& part);

}  // namespace phare
