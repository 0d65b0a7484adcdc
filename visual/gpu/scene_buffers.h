// A scene on the device, and which of its chunks a view has to draw.
#pragma once

#include <array>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "shaders/lamps.h"
#include "visual/fixed_light.h"
#include "visual/gpu/device.h"
#include "visual/gpu/surface_textures.h"
#include "visual/renderer.h"
#include "visual/scene/batch_pieces.h"
#include "visual/scene/far_mesh.h"
#include "visual/scene/ground_heights.h"
#include "visual/scene/horizon.h"
#include "visual/scene/scene.h"
#include "visual/shadow_casters.h"

namespace phare {

/// What makes a pipeline: materials of one kind are drawn together.
struct MaterialKind {
  Surface surface = Surface::kPlain;
  RetroKind retro = RetroKind::kNone;
  bool double_sided = false;
  bool flat = false;  ///< each triangle's normal is that of its plane (visual/scene/scene.h)
  std::uint32_t look = 0;  ///< as kSpecLook
  bool road = false;  ///< asphalt whose vertices keep a FixedRoad
  /// Neither rain nor snow lies on it (chosen): less than half of the sky reaches it, or it shines by itself.
  bool sheltered = false;

  friend auto operator<=>(const MaterialKind&, const MaterialKind&) = default;
};

/// Kinds in the order in which they are drawn: paint before the road that it lies on, which it hides.
inline auto drawn_by(const MaterialKind& kind) {
  return std::pair(kind.surface == Surface::kPaint ? Surface::kPlain : kind.surface, kind);
}

/// A vertex on the device.
struct GpuVertex {
  glm::vec3 position_m;  ///< relative to the batch's origin
  glm::vec3 normal;
  std::uint32_t material = 0;
};

/// What of a CornerLook every such vertex has; a relief's tangents lie apart.
struct GpuCornerLook {
  glm::vec2 uv;
  glm::u16vec4 colour;
};

/// Chunks of one kind in one cell of the ground, drawn in one call: on a software device a call costs as much as a
/// hundred triangles.
struct SceneBatch {
  MaterialKind kind;
  glm::dvec3 origin_m{0.0};
  glm::dvec3 low_m{0.0}, high_m{0.0};
  std::uint32_t first_index = 0, index_count = 0;
  std::int32_t first_vertex = 0;
  /// One behind the other all of its triangles, of what stands, but leaves; else none.
  std::vector<BatchPiece> pieces{};
  /// The same triangles in kOrders orders, one behind the other: near ones first for who looks along x, then turned to
  /// the left in even steps. Leaves lie behind leaves, and what is drawn first hides the rest before it is lit.
  bool ordered = false;
  std::uint32_t first_look = 0;  ///< of its vertices, where the kind has a look; then all are of one material
  std::size_t look_of = 0;       ///< which
  std::uint32_t first_tangent = 0;  ///< of its vertices, where the kind has a relief
  std::uint32_t first_road = 0;     ///< of its vertices, where the kind is of asphalt
  bool bent = false;                ///< some of its kind (visual/scene/scene.h)
  static constexpr std::uint32_t kOrders = 8;
  /// Of the order for who looks along (x, y).
  std::uint32_t first_index_along(const glm::dvec2& direction) const;
};

/// A piece of the ground: its batches in full, and as they are drawn from afar (visual/scene/far_mesh.h).
struct SceneBlock {
  glm::dvec3 low_m{0.0}, high_m{0.0};
  std::vector<SceneBatch> near{};
  std::size_t first_far = 0;  ///< far levels before it are empty: drawn by `near`
  std::array<std::vector<SceneBatch>, kFarLevels.size()> far{};
};

/// One batch to draw, ready for its push constants.
struct DrawItem {
  const SceneBatch* batch = nullptr;
  std::uint32_t first_index = 0, index_count = 0;  ///< of the order that is drawn, all of it or a part
  shader::GpuDraw push{};
  float distance_m = 0.0f;
  std::size_t lit_by = 0;         ///< which of the view's sets of lamps (visual/lit_scene.h)
  bool shadowed = false;          ///< a shadow may fall on it (visual/passes/shadows.h)
  std::uint32_t moves = kStands;  ///< which of what moves it is

  static constexpr std::uint32_t kStands = UINT32_MAX;

  /// Its push constants are the same.
  bool is_placed_as(const DrawItem& other) const;
};

/// What moves, about its own origin.
struct MovingMesh {
  std::string node;
  std::vector<SceneBatch> batches{};
  std::array<std::vector<SceneBatch>, kFarLevels.size()> far{};  ///< as drawn from afar: from kFirstFarOfThings on
  double radius_m = 0.0;                                         ///< about its origin, of all of it
};

struct SceneBuffers {
  std::vector<SceneBlock> blocks;
  std::vector<MovingMesh> moving;  ///< one for each node of the scene of what moves, in its order
  gpu::DeviceBuffer vertices, indices, material_buffer, sheeting_buffer;
  gpu::DeviceBuffer looks;  ///< GpuCornerLook of the vertices of batches that have a look, and of no others
  gpu::DeviceBuffer tangents;  ///< CornerLook::tangent of those that have a relief
  gpu::DeviceBuffer fixed_light;  ///< FixedVertex of each vertex of what stands; none where nothing shines
  gpu::DeviceBuffer ways;  ///< FixedWay of those vertices that have a relief and stand, as `tangents`
  gpu::DeviceBuffer road;  ///< FixedRoad of the vertices of asphalt; none where no lamp shines on it
  SurfaceTextures textures;
  GroundHeights ground;
  std::vector<FarCasters> far_casters;  ///< of each chunk of what stands, to be taken

  SceneBuffers() = default;
  SceneBuffers(gpu::Device& device, const Scene& scene, const Scene& moving, const FixedLight& light,
               const Progress& progress = {});

  /// Batches whose bounds touch the view, those of one kind together, near ones first.
  /// Blocks that begin at the multiples kFarLevels of `far_from_m` or beyond are drawn with their far meshes, and of
  /// these the pieces that touch the view. `horizon`: of the view's eye; what it hides is left out; or nullptr.
  std::vector<DrawItem> visible(const ViewGeometry& view, double far_from_m, Horizon* horizon) const;
  /// The same for what moves. `placed`: keeps the batches where they are now, for the items.
  void add_visible(std::vector<DrawItem>& items, std::vector<SceneBatch>& placed, const ViewGeometry& view,
                   std::span<const PlacedMesh> meshes, double far_from_m, Horizon* horizon) const;
};

}  // namespace phare
