#include "visual/gpu/scene_buffers.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <tuple>

#include "config/base/conventions.h"
#include "visual/gpu/pack_materials.h"
#include "visual/scene/far_mesh.h"
#include "visual/scene/refine.h"

namespace phare {

namespace {

// Side of the cells that batches are gathered in. Smaller culls better, larger draws fewer: chosen by timing the
// country road.
constexpr double kBlock_m = 96.0;
// Of leaves, which have many triangles: their level changes by the tree. So does that of things where more than
// kManyTriangles of them stand in a block, as houses and parked cars do in a town: 24 m took less time there than 16 or
// 48. Where there are fewer, more calls (SceneBatch) cost what they save.
constexpr double kSmallBlock_m = 24.0;
constexpr std::size_t kManyTriangles = 3000;  // chosen: as many as thirty calls cost

using Cell = std::pair<std::int64_t, std::int64_t>;

Cell cell_of(const SceneChunk& chunk, double side_m) {
  const glm::dvec3 centre = (chunk.low_m + chunk.high_m) * 0.5;
  return {static_cast<std::int64_t>(std::floor(centre.x / side_m)),
          static_cast<std::int64_t>(std::floor(centre.y / side_m))};
}

/// Of far meshes: one for all in a cube of the side in which the grain of surfaces repeats, so that they are drawn
/// together; a road that begins at the world's origin, as most do, lies in the middle of one. Float32 holds places in
/// it to 0.06 mm.
glm::dvec3 far_origin_m(const SceneChunk& chunk) {
  constexpr double kSide_m = 1024.0;
  const glm::dvec3 centre = (chunk.low_m + chunk.high_m) * (0.5 / kSide_m);
  return glm::round(centre) * kSide_m;
}

struct Gathered {
  std::vector<GpuVertex> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<GpuCornerLook> looks;
  std::vector<glm::i8vec4> tangents;
  bool textures = true;          ///< the device can draw them
  std::size_t first_material = 0;  ///< of the scene that is gathered
  std::vector<FixedVertex> light{};              // of the vertices of what stands
  std::vector<FixedWay> ways{};                  // of its vertices that have a relief
  std::vector<FixedRoad> road{};                 // of the vertices of its asphalt
  std::vector<FarCasters> far_casters{};         // of the chunks of what stands
  std::vector<FixedLight::Meshes> lit_meshes{};  // of the chunks of what stands; none where nothing shines
};

void append(Gathered& all, const SceneBatch& batch, const SceneChunk& chunk, std::span<const SceneVertex> vertices,
            std::span<const std::uint32_t> indices, std::span<const CornerLook> looks) {
  const auto base = static_cast<std::uint32_t>(all.vertices.size()) - static_cast<std::uint32_t>(batch.first_vertex);
  const glm::vec3 shift(chunk.origin_m - batch.origin_m);
  for (const SceneVertex& vertex : vertices)
    all.vertices.push_back({vertex.position_m + shift, vertex.normal, chunk.material});
  for (std::uint32_t index : indices) all.indices.push_back(base + index);
  if (batch.kind.look == 0) return;
  for (const CornerLook& look : looks) all.looks.push_back({look.uv, look.colour});
  if (batch.kind.look & shader::kLookRelief)
    for (const CornerLook& look : looks) all.tangents.push_back(look.tangent);
}

glm::dvec2 order_direction(std::uint32_t order) {
  const double turn = 2.0 * std::numbers::pi * order / SceneBatch::kOrders;
  return {std::cos(turn), std::sin(turn)};
}

void add_orders(SceneBatch& batch, Gathered& all) {
  struct Triangle {
    std::array<std::uint32_t, 3> corners;
    float nearest_m;
  };
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < batch.index_count; i += 3) {
    const std::uint32_t* corners = &all.indices[batch.first_index + i];
    triangles.push_back({{corners[0], corners[1], corners[2]}, 0.0f});
  }
  all.indices.resize(batch.first_index);
  for (std::uint32_t order = 0; order < SceneBatch::kOrders; ++order) {
    const glm::vec3 along(order_direction(order), 0.0);
    const auto depth_m = [&](std::uint32_t corner) {
      return glm::dot(along, all.vertices[static_cast<std::size_t>(batch.first_vertex) + corner].position_m);
    };
    for (Triangle& t : triangles)
      t.nearest_m = std::min({depth_m(t.corners[0]), depth_m(t.corners[1]), depth_m(t.corners[2])});
    std::ranges::stable_sort(triangles, {}, &Triangle::nearest_m);
    for (const Triangle& t : triangles) all.indices.insert(all.indices.end(), t.corners.begin(), t.corners.end());
  }
  batch.ordered = true;
}

/// A chunk as it is drawn. The spans stay good while it is moved: so do the words of a vector.
struct DrawnChunk {
  const SceneChunk* chunk;
  std::optional<FarMesh> far{};  ///< none: in full
  std::span<const SceneVertex> vertices{};
  std::span<const std::uint32_t> indices{};
  std::span<const CornerLook> looks{};
  std::span<const FixedVertex> light{};  // none where nothing shines
  std::span<const FixedRoad> road{};
  std::span<const FixedWay> ways{};
};

DrawnChunk drawn(const Scene& scene, const SceneChunk& chunk, std::optional<std::size_t> far_level,
                 const Gathered& all) {
  DrawnChunk drawn{.chunk = &chunk};
  if (!all.lit_meshes.empty()) {
    const auto index = static_cast<std::size_t>(&chunk - scene.chunks.data());
    const FixedMesh& mesh = all.lit_meshes[index][far_level ? 1 + *far_level : 0];
    drawn.vertices = mesh.vertices, drawn.indices = mesh.indices, drawn.light = mesh.light, drawn.looks = mesh.looks;
    drawn.road = mesh.road, drawn.ways = mesh.ways;
  } else if (far_level) {
    drawn.far = far_mesh(scene, chunk, *far_level, kFarLevels[*far_level].from * kFarMeshFrom_m);
    drawn.vertices = drawn.far->vertices, drawn.indices = drawn.far->indices, drawn.looks = drawn.far->looks;
  } else {
    drawn.vertices = std::span(scene.vertices).subspan(chunk.first_vertex, chunk.vertex_count);
    drawn.indices = std::span(scene.indices).subspan(chunk.first_index, chunk.index_count);
    if (chunk.first_look) drawn.looks = std::span(scene.looks).subspan(*chunk.first_look, chunk.vertex_count);
  }
  return drawn;
}

// Ground casts as a whole: where it hides a lamp behind a crest, a hand's breadth of height is metres of shadow.
void keep_far_caster(const Scene& scene, const DrawnChunk& mesh, std::size_t level, Gathered& all) {
  if (level >= kFarCasterLevels || is_ground(scene.materials[mesh.chunk->material])) return;
  FarCasters& far = all.far_casters[static_cast<std::size_t>(mesh.chunk - scene.chunks.data())];
  far.resize(level);  // those that it has none of
  // What loses no triangle is the mesh before: a large scene is not kept twice.
  std::size_t before = mesh.chunk->index_count;
  for (const std::optional<CasterMesh>& kept : far)
    if (kept) before = kept->indices.size();
  if (mesh.indices.size() == before) {
    far.emplace_back();
    return;
  }
  CasterMesh& kept = far.emplace_back().emplace();
  for (const SceneVertex& vertex : mesh.vertices) kept.corners_m.push_back(vertex.position_m);
  kept.indices.assign(mesh.indices.begin(), mesh.indices.end());
  for (const CornerLook& look : mesh.looks) kept.uvs.push_back(look.uv);
}

bool is_flat_whole(const Scene& scene, const SceneChunk& chunk) {
  return is_flat(std::span(scene.vertices).subspan(chunk.first_vertex, chunk.vertex_count),
                 std::span(scene.indices).subspan(chunk.first_index, chunk.index_count));
}

// One batch for each kind and cell of `side_m` among the chunks.
std::vector<SceneBatch> gather(const Scene& scene, const std::vector<const SceneChunk*>& chunks, double side_m,
                               std::optional<std::size_t> far_level, bool stands, Gathered& all) {
  // Of what has a look, one for each material besides: its textures are bound for it.
  std::map<std::tuple<MaterialKind, std::size_t, Cell>, std::vector<DrawnChunk>> groups;
  for (const SceneChunk* chunk : chunks) {
    const SceneMaterial& material = scene.materials[chunk->material];
    const std::uint32_t look = all.textures && chunk->first_look ? look_bits(material) : 0;
    DrawnChunk mesh = drawn(scene, *chunk, far_level, all);
    if (far_level && stands) keep_far_caster(scene, mesh, *far_level, all);
    // A pupil's light is drawn by itself (visual/eyeshine.h).
    const RetroKind retro = material.retro.kind == RetroKind::kPupil ? RetroKind::kNone : material.retro.kind;
    // What moves is of the same kinds from afar: it comes nearer, and no pipeline is to be made then.
    const bool flat = stands ? is_flat(mesh.vertices, mesh.indices) : is_flat_whole(scene, *chunk);
    const MaterialKind kind{.surface = material.surface,
                            .retro = retro,
                            .double_sided = material.double_sided,
                            .flat = look == 0 && flat,
                            .look = look,
                            .road = !mesh.road.empty(),
                            .sheltered = material.sky_share < 0.5f || material.emission_cdm2 != glm::vec3(0.0f)};
    groups[{kind, look != 0 ? all.first_material + chunk->material : 0, cell_of(*chunk, side_m)}].push_back(
        std::move(mesh));
  }
  std::vector<SceneBatch> batches;
  for (const auto& [key, group] : groups) {
    const SceneChunk& first = *group.front().chunk;
    SceneBatch batch{.kind = std::get<0>(key),
                     .origin_m = far_level && stands ? far_origin_m(first) : first.origin_m,
                     .low_m = first.low_m,
                     .high_m = first.high_m};
    batch.first_index = static_cast<std::uint32_t>(all.indices.size());
    batch.first_vertex = static_cast<std::int32_t>(all.vertices.size());
    batch.first_look = static_cast<std::uint32_t>(all.looks.size());
    batch.first_tangent = static_cast<std::uint32_t>(all.tangents.size());
    batch.first_road = static_cast<std::uint32_t>(all.road.size());
    batch.look_of = std::get<1>(key);
    std::vector<std::size_t> ends;
    for (const DrawnChunk& mesh : group) {
      append(all, batch, *mesh.chunk, mesh.vertices, mesh.indices, mesh.looks);
      ends.push_back(all.indices.size() - batch.first_index);
      batch.bent = batch.bent || is_bent(mesh.vertices, mesh.indices);
      all.light.insert(all.light.end(), mesh.light.begin(), mesh.light.end());
      if (batch.kind.look & shader::kLookRelief) all.ways.insert(all.ways.end(), mesh.ways.begin(), mesh.ways.end());
      all.road.insert(all.road.end(), mesh.road.begin(), mesh.road.end());
      batch.low_m = glm::min(batch.low_m, mesh.chunk->low_m);
      batch.high_m = glm::max(batch.high_m, mesh.chunk->high_m);
    }
    batch.index_count = static_cast<std::uint32_t>(all.indices.size()) - batch.first_index;
    if (batch.kind.surface == Surface::kFoliage)
      add_orders(batch, all);
    else if (stands)
      batch.pieces = cut_into_pieces(
          std::span(all.indices).subspan(batch.first_index, batch.index_count), ends,
          [&](std::uint32_t corner) {
            return all.vertices[static_cast<std::size_t>(batch.first_vertex) + corner].position_m;
          },
          far_level ? kFarPieces : kNearPieces);
    if (batch.index_count > 0) batches.push_back(std::move(batch));
  }
  return batches;
}

std::vector<SceneBlock> make_blocks(const Scene& scene, Gathered& all, const Progress& progress) {
  const auto is_thing = [&](const SceneChunk& chunk) {
    return scene.materials[chunk.material].surface == Surface::kPlain;
  };
  std::map<Cell, std::size_t> triangles_of_things;  // by blocks of kBlock_m
  for (const SceneChunk& chunk : scene.chunks)
    if (is_thing(chunk)) triangles_of_things[cell_of(chunk, kBlock_m)] += chunk.index_count / 3;
  std::map<std::tuple<std::size_t, bool, Cell>, std::vector<const SceneChunk*>> cells;
  for (const SceneChunk& chunk : scene.chunks) {
    const SceneMaterial& material = scene.materials[chunk.material];
    const bool small = material.surface == Surface::kFoliage ||
                       (is_thing(chunk) && triangles_of_things[cell_of(chunk, kBlock_m)] > kManyTriangles);
    cells[{first_far_level(material), small, cell_of(chunk, small ? kSmallBlock_m : kBlock_m)}].push_back(&chunk);
  }
  std::vector<SceneBlock> blocks;
  for (const auto& [cell, chunks] : cells) {
    if (progress)
      progress(static_cast<double>(blocks.size()) / static_cast<double>(cells.size()), "levels of detail");
    SceneBlock block{.low_m = chunks.front()->low_m, .high_m = chunks.front()->high_m, .first_far = std::get<0>(cell)};
    for (const SceneChunk* chunk : chunks) {
      block.low_m = glm::min(block.low_m, chunk->low_m);
      block.high_m = glm::max(block.high_m, chunk->high_m);
    }
    block.near = gather(scene, chunks, kBlock_m, std::nullopt, true, all);
    for (std::size_t level = block.first_far; level < kFarLevels.size(); ++level)
      block.far[level] = gather(scene, chunks, kBlock_m, level, true, all);
    blocks.push_back(std::move(block));
  }
  return blocks;
}

// Where some of a kind is bent all of it counts as bent, near and far: else a drive would come to pairs of both that were
// not there before it, and have pipelines made for them.
void bend_by_kind(std::vector<SceneBlock>& blocks, std::vector<MovingMesh>& moving) {
  const auto every_batch = [&](const auto& visit) {
    for (SceneBlock& block : blocks) {
      std::ranges::for_each(block.near, visit);
      for (std::vector<SceneBatch>& far : block.far) std::ranges::for_each(far, visit);
    }
    for (MovingMesh& mesh : moving) {
      std::ranges::for_each(mesh.batches, visit);
      for (std::vector<SceneBatch>& far : mesh.far) std::ranges::for_each(far, visit);
    }
  };
  const auto kind_of = [](const SceneBatch& batch) {
    MaterialKind kind = batch.kind;
    kind.flat = kind.road = kind.sheltered = false;  // of which there may be both
    return kind;
  };
  std::set<MaterialKind> bent;
  every_batch([&](const SceneBatch& batch) {
    if (batch.bent) bent.insert(kind_of(batch));
  });
  every_batch([&](SceneBatch& batch) { batch.bent = bent.contains(kind_of(batch)); });
}

// `first_material`: theirs stand behind those of the scene.
std::vector<MovingMesh> make_moving(const Scene& scene, std::uint32_t first_material, Gathered& all) {
  std::vector<MovingMesh> meshes;
  std::vector<std::vector<const SceneChunk*>> chunks;
  for (const SceneChunk& chunk : scene.chunks) {
    auto mesh = std::ranges::find(meshes, chunk.node, &MovingMesh::node);
    if (mesh == meshes.end()) {
      mesh = meshes.insert(meshes.end(), {chunk.node});
      chunks.emplace_back();
    }
    chunks[static_cast<std::size_t>(mesh - meshes.begin())].push_back(&chunk);
  }
  const std::size_t first_vertex = all.vertices.size();
  all.first_material = first_material;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    meshes[i].batches = gather(scene, chunks[i], kBlock_m, std::nullopt, false, all);
    for (std::size_t level = kFirstFarOfThings; level < kFarLevels.size(); ++level)
      meshes[i].far[level] = gather(scene, chunks[i], kBlock_m, level, false, all);
    for (const SceneChunk* chunk : chunks[i])
      meshes[i].radius_m =
          std::max(meshes[i].radius_m, glm::length(glm::max(glm::abs(chunk->low_m), glm::abs(chunk->high_m))));
  }
  for (GpuVertex& vertex : std::span(all.vertices).subspan(first_vertex)) vertex.material += first_material;
  return meshes;
}

// Across the ground, of a view to a batch; within it, straight ahead.
glm::dvec2 looks_along(const ViewGeometry& view, const SceneBatch& batch) {
  const glm::dvec3& eye_m = view.camera().eye_m;
  const bool within = glm::clamp(eye_m, batch.low_m, batch.high_m) == eye_m;
  return within ? glm::dvec2(view.camera().world_from_eye[0]) : glm::dvec2(0.5 * (batch.low_m + batch.high_m) - eye_m);
}

shader::GpuDraw draw_at(const glm::dvec3& from_eye_m, const glm::dvec3& detail_m, const glm::dmat3& turn) {
  // What is off the grid is the same for all that stands, and goes apart: no crack opens between pieces.
  shader::GpuDraw draw{glm::vec4(glm::vec3(on_place_grid(from_eye_m)), 0.0f), glm::vec4(glm::vec3(detail_m), 0.0f), {}};
  const glm::dmat3 rows = glm::transpose(turn);
  for (int i = 0; i < 3; ++i)
    draw.turn[i] =
        glm::vec4(glm::vec3(rows[i]), static_cast<float>(from_eye_m[i] - static_cast<double>(draw.origin[i])));
  return draw;
}

bool hidden(Horizon* horizon, const glm::dvec3& low_m, const glm::dvec3& high_m) {
  return horizon != nullptr && horizon->hides(low_m, high_m);
}

// Of the last item the pieces that the view sees, those that follow one another as one.
void keep_seen(std::vector<DrawItem>& items, const ViewGeometry& view, Horizon& horizon) {
  const SceneBatch& batch = *items.back().batch;
  if (batch.pieces.size() < 2) return;
  const DrawItem whole = items.back();
  items.pop_back();
  std::uint32_t first_index = whole.first_index;
  bool seen_before = false;
  for (const BatchPiece& piece : batch.pieces) {
    const glm::dvec3 low_m = batch.origin_m + glm::dvec3(piece.low_m),
                     high_m = batch.origin_m + glm::dvec3(piece.high_m);
    const bool seen = view.sees(low_m, high_m) && !horizon.hides(low_m, high_m);
    if (seen && !seen_before) {
      items.push_back(whole);
      items.back().first_index = first_index, items.back().index_count = 0;
    }
    if (seen) items.back().index_count += piece.index_count;
    seen_before = seen;
    first_index += piece.index_count;
  }
}

// Those of one kind together.
void near_first(std::vector<DrawItem>& items) {
  const auto place = [](const DrawItem& item) {
    return std::tuple(drawn_by(item.batch->kind), item.distance_m, item.batch->first_index, item.first_index);
  };
  std::sort(items.begin(), items.end(), [&](const DrawItem& a, const DrawItem& b) { return place(a) < place(b); });
}

}  // namespace

std::uint32_t SceneBatch::first_index_along(const glm::dvec2& direction) const {
  if (!ordered) return first_index;
  const double turns = std::atan2(direction.y, direction.x) / (2.0 * std::numbers::pi);
  const auto order = static_cast<std::uint32_t>(std::lround((turns + 1.0) * kOrders)) % kOrders;
  return first_index + order * index_count;
}

bool DrawItem::is_placed_as(const DrawItem& other) const {
  return moves == other.moves && std::memcmp(&push, &other.push, sizeof push) == 0;
}

SceneBuffers::SceneBuffers(gpu::Device& device, const Scene& scene, const Scene& moving_scene,
                           const FixedLight& light, const Progress& progress) {
  const PackedMaterials packed = pack_materials(scene, moving_scene);
  ground = GroundHeights(scene);
  Gathered all;
  if (!scene.looks.empty() || !moving_scene.looks.empty()) {
    const char* why_not = no_textures(device);
    all.textures = why_not == nullptr;
    if (why_not != nullptr) spdlog::warn("surfaces are drawn without their textures: {}", why_not);
  }
  if (light.any()) all.lit_meshes = light.meshes(scene);
  all.far_casters.resize(scene.chunks.size());
  blocks = make_blocks(scene, all, progress);
  far_casters = std::move(all.far_casters);
  all.lit_meshes.clear();
  moving = make_moving(moving_scene, static_cast<std::uint32_t>(scene.materials.size()), all);
  bend_by_kind(blocks, moving);
  using Usage = vk::BufferUsageFlagBits;
  vertices = gpu::DeviceBuffer(device, std::as_bytes(std::span(all.vertices)),
                               Usage::eVertexBuffer | Usage::eStorageBuffer, "scene vertices");
  std::vector<GpuVertex>().swap(all.vertices);  // of large scenes neither is held longer than it is needed
  if (!all.light.empty())
    fixed_light = gpu::DeviceBuffer(device, std::as_bytes(std::span(all.light)), Usage::eVertexBuffer, "fixed light");
  if (!all.ways.empty())
    ways = gpu::DeviceBuffer(device, std::as_bytes(std::span(all.ways)), Usage::eVertexBuffer, "light on reliefs");
  if (!all.road.empty())
    road = gpu::DeviceBuffer(device, std::as_bytes(std::span(all.road)), Usage::eVertexBuffer, "asphalt");
  indices = gpu::DeviceBuffer(device, std::as_bytes(std::span(all.indices)),
                              Usage::eIndexBuffer | Usage::eStorageBuffer, "scene indices");
  std::vector<std::uint32_t>().swap(all.indices);
  if (!all.looks.empty()) {
    const std::array scenes{&scene, &moving_scene};
    textures = SurfaceTextures(device, scenes);
    looks = gpu::DeviceBuffer(device, std::as_bytes(std::span(all.looks)), Usage::eVertexBuffer, "looks of corners");
    if (!all.tangents.empty())
      tangents = gpu::DeviceBuffer(device, std::as_bytes(std::span(all.tangents)), Usage::eVertexBuffer, "tangents");
  }
  material_buffer =
      gpu::DeviceBuffer(device, std::as_bytes(std::span(packed.materials)), Usage::eUniformBuffer, "materials");
  sheeting_buffer =
      gpu::DeviceBuffer(device, std::as_bytes(std::span(packed.sheetings)), Usage::eUniformBuffer, "sheetings");
}

std::vector<DrawItem> SceneBuffers::visible(const ViewGeometry& view, double far_from_m, Horizon* horizon) const {
  std::vector<DrawItem> items;
  items.reserve(256);  // some hundred are seen
  for (const SceneBlock& block : blocks) {
    const std::optional<double> block_at = view.sees(block.low_m, block.high_m);
    if (!block_at || hidden(horizon, block.low_m, block.high_m)) continue;
    const std::vector<SceneBatch>* batches = &block.near;
    for (std::size_t level = block.first_far; level < kFarLevels.size(); ++level)
      if (*block_at >= kFarLevels[level].from * far_from_m) batches = &block.far[level];
    for (const SceneBatch& batch : *batches) {
      const std::optional<double> distance = view.sees(batch.low_m, batch.high_m);
      if (!distance || hidden(horizon, batch.low_m, batch.high_m)) continue;
      const glm::dvec3 detail = batch.origin_m - glm::floor(batch.origin_m / 1024.0) * 1024.0;
      items.push_back({&batch, batch.first_index_along(looks_along(view, batch)), batch.index_count,
                       draw_at(batch.origin_m - view.camera().eye_m, detail, glm::dmat3(1.0)),
                       static_cast<float>(*distance)});
      if (batches != &block.near && horizon != nullptr) keep_seen(items, view, *horizon);
    }
  }
  near_first(items);
  return items;
}

void SceneBuffers::add_visible(std::vector<DrawItem>& items, std::vector<SceneBatch>& placed, const ViewGeometry& view,
                               std::span<const PlacedMesh> meshes, double far_from_m, Horizon* horizon) const {
  std::size_t count = 0;
  for (const PlacedMesh& mesh : meshes) count += mesh.mesh < moving.size() ? moving[mesh.mesh].batches.size() : 0;
  placed.reserve(count);  // items point to them; from afar there are no more
  for (const PlacedMesh& mesh : meshes) {
    if (mesh.mesh >= moving.size()) continue;
    const glm::dmat3& turn = mesh.world_from_mesh;
    const glm::dmat3 extent(glm::abs(turn[0]), glm::abs(turn[1]), glm::abs(turn[2]));
    const double distance_m = glm::distance(view.camera().eye_m, mesh.position_m) - moving[mesh.mesh].radius_m;
    const std::vector<SceneBatch>* batches = &moving[mesh.mesh].batches;
    for (std::size_t level = kFirstFarOfThings; level < kFarLevels.size(); ++level)
      if (distance_m >= kFarLevels[level].from * far_from_m) batches = &moving[mesh.mesh].far[level];
    for (const SceneBatch& batch : *batches) {
      SceneBatch there = batch;
      const glm::dvec3 middle_m = mesh.position_m + turn * (0.5 * (batch.low_m + batch.high_m));
      const glm::dvec3 half_m = extent * (0.5 * (batch.high_m - batch.low_m));
      there.low_m = middle_m - half_m, there.high_m = middle_m + half_m;
      there.origin_m = mesh.position_m + turn * batch.origin_m;
      const std::optional<double> distance = view.sees(there.low_m, there.high_m);
      if (!distance || hidden(horizon, there.low_m, there.high_m)) continue;
      placed.push_back(there);
      items.push_back({&placed.back(), batch.first_index, batch.index_count,
                       draw_at(there.origin_m - view.camera().eye_m, batch.origin_m, turn),
                       static_cast<float>(*distance)});
      items.back().moves = static_cast<std::uint32_t>(&mesh - meshes.data());
    }
  }
  near_first(items);
}

}  // namespace phare
