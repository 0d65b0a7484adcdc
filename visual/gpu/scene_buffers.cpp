#include "visual/gpu/scene_buffers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <tuple>

namespace phare {

namespace {

// Side of the cells that batches are gathered in. Smaller culls better, larger draws fewer: chosen by timing the country road.
constexpr double kCell_m = 64.0;

std::vector<SceneBatch> gather(const Scene& scene, std::vector<GpuVertex>& vertices, std::vector<std::uint32_t>& indices) {
  using Key = std::tuple<MaterialKind, std::int64_t, std::int64_t>;
  std::map<Key, std::vector<const SceneChunk*>> cells;
  for (const SceneChunk& chunk : scene.chunks) {
    const SceneMaterial& material = scene.materials[chunk.material];
    const glm::dvec3 centre = (chunk.low_m + chunk.high_m) * 0.5;
    cells[{{material.surface, material.retroreflection_cd_per_lx_m2 > 0.0f},
           static_cast<std::int64_t>(std::floor(centre.x / kCell_m)),
           static_cast<std::int64_t>(std::floor(centre.y / kCell_m))}]
        .push_back(&chunk);
  }
  std::vector<SceneBatch> batches;
  for (const auto& [key, chunks] : cells) {
    SceneBatch batch{.kind = std::get<0>(key), .origin_m = chunks.front()->origin_m, .low_m = chunks.front()->low_m, .high_m = chunks.front()->high_m};
    batch.first_index = static_cast<std::uint32_t>(indices.size());
    batch.first_vertex = static_cast<std::int32_t>(vertices.size());
    for (const SceneChunk* chunk : chunks) {
      const auto base = static_cast<std::uint32_t>(vertices.size()) - static_cast<std::uint32_t>(batch.first_vertex);
      const glm::vec3 shift(chunk->origin_m - batch.origin_m);
      for (std::uint32_t i = 0; i < chunk->vertex_count; ++i) {
        const SceneVertex& vertex = scene.vertices[chunk->first_vertex + i];
        vertices.push_back({vertex.position_m + shift, vertex.normal, chunk->material});
      }
      for (std::uint32_t i = 0; i < chunk->index_count; ++i) indices.push_back(base + scene.indices[chunk->first_index + i]);
      batch.low_m = glm::min(batch.low_m, chunk->low_m);
      batch.high_m = glm::max(batch.high_m, chunk->high_m);
    }
    batch.index_count = static_cast<std::uint32_t>(indices.size()) - batch.first_index;
    batches.push_back(batch);
  }
  return batches;
}

}  // namespace

SceneBuffers::SceneBuffers(gpu::Device& device, const Scene& scene) {
  std::vector<shader::GpuMaterial> packed;
  for (const SceneMaterial& material : scene.materials)
    packed.push_back({glm::vec4(material.reflectance, material.retroreflection_cd_per_lx_m2)});
  if (packed.size() > shader::kMaxMaterials)
    throw std::runtime_error(std::to_string(packed.size()) + " materials, at most " + std::to_string(shader::kMaxMaterials) + " are drawn");
  packed.resize(shader::kMaxMaterials, {glm::vec4(0.5f, 0.5f, 0.5f, 0.0f)});
  std::vector<GpuVertex> gathered;
  std::vector<std::uint32_t> gathered_indices;
  batches = gather(scene, gathered, gathered_indices);
  using Usage = vk::BufferUsageFlagBits;
  vertices = gpu::DeviceBuffer(device, std::as_bytes(std::span(gathered)), Usage::eVertexBuffer, "scene vertices");
  indices = gpu::DeviceBuffer(device, std::as_bytes(std::span(gathered_indices)), Usage::eIndexBuffer, "scene indices");
  material_buffer = gpu::DeviceBuffer(device, std::as_bytes(std::span(packed)), Usage::eUniformBuffer, "materials");
}

std::vector<DrawItem> SceneBuffers::visible(const Camera& camera, double aspect) const {
  // Planes of the view as inward normals in the eye's frame (forward, left, up); a box is out when its nearest corner is.
  std::array<glm::dvec4, 5> planes{};
  const glm::dmat3& axes = camera.world_from_eye;
  if (camera.orthographic_width_m > 0.0) {
    const double half_width = camera.orthographic_width_m / 2.0;
    const double half_height = half_width / aspect;
    planes = {glm::dvec4(axes[1], half_width), glm::dvec4(-axes[1], half_width), glm::dvec4(axes[2], half_height),
              glm::dvec4(-axes[2], half_height), glm::dvec4(axes[0], 0.0)};
  } else {
    const double tan_h = std::tan(camera.fov_horizontal_rad / 2.0);
    const double tan_v = tan_h / aspect;
    planes = {glm::dvec4(glm::normalize(axes[0] * tan_h + axes[1]), 0.0), glm::dvec4(glm::normalize(axes[0] * tan_h - axes[1]), 0.0),
              glm::dvec4(glm::normalize(axes[0] * tan_v + axes[2]), 0.0), glm::dvec4(glm::normalize(axes[0] * tan_v - axes[2]), 0.0),
              glm::dvec4(axes[0], 0.0)};
  }
  std::vector<DrawItem> items;
  for (const SceneBatch& batch : batches) {
    const glm::dvec3 centre = (batch.low_m + batch.high_m) * 0.5 - camera.eye_m;
    const glm::dvec3 half = (batch.high_m - batch.low_m) * 0.5;
    const bool out = std::any_of(planes.begin(), planes.end(), [&](const glm::dvec4& plane) {
      const glm::dvec3 normal(plane);
      return glm::dot(normal, centre) + glm::dot(glm::abs(normal), half) + plane.w < 0.0;
    });
    if (out) continue;
    const glm::dvec3 nearest = glm::max(glm::abs(centre) - half, glm::dvec3(0.0));
    const double distance = glm::length(nearest);
    if (distance > camera.far_m) continue;
    const glm::dvec3 origin = batch.origin_m - camera.eye_m;
    const glm::dvec3 detail = batch.origin_m - glm::floor(batch.origin_m / 1024.0) * 1024.0;
    items.push_back({&batch, {glm::vec4(glm::vec3(origin), 0.0f), glm::vec4(glm::vec3(detail), 0.0f)}, static_cast<float>(distance)});
  }
  std::sort(items.begin(), items.end(), [](const DrawItem& a, const DrawItem& b) {
    return std::tuple(a.batch->kind, a.distance_m, a.batch->first_index) < std::tuple(b.batch->kind, b.distance_m, b.batch->first_index);
  });
  return items;
}

}  // namespace phare
