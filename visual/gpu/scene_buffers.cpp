#include "visual/gpu/scene_buffers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace phare {

SceneBuffers::SceneBuffers(gpu::Device& device, const Scene& scene) : materials(scene.materials), chunks(scene.chunks) {
  std::vector<shader::GpuMaterial> packed;
  for (const SceneMaterial& material : materials)
    packed.push_back({glm::vec4(material.reflectance, material.retroreflection_cd_per_lx_m2)});
  if (packed.empty()) packed.push_back({glm::vec4(0.5f, 0.5f, 0.5f, 0.0f)});
  using Usage = vk::BufferUsageFlagBits;
  vertices = gpu::DeviceBuffer(device, std::as_bytes(std::span(scene.vertices)), Usage::eVertexBuffer, "scene vertices");
  indices = gpu::DeviceBuffer(device, std::as_bytes(std::span(scene.indices)), Usage::eIndexBuffer, "scene indices");
  material_buffer = gpu::DeviceBuffer(device, std::as_bytes(std::span(packed)), Usage::eStorageBuffer, "materials");
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
  for (const SceneChunk& chunk : chunks) {
    const glm::dvec3 centre = (chunk.low_m + chunk.high_m) * 0.5 - camera.eye_m;
    const glm::dvec3 half = (chunk.high_m - chunk.low_m) * 0.5;
    const bool out = std::any_of(planes.begin(), planes.end(), [&](const glm::dvec4& plane) {
      const glm::dvec3 normal(plane);
      return glm::dot(normal, centre) + glm::dot(glm::abs(normal), half) + plane.w < 0.0;
    });
    if (out) continue;
    const glm::dvec3 nearest = glm::max(glm::abs(centre) - half, glm::dvec3(0.0));
    const double distance = glm::length(nearest);
    if (distance > camera.far_m) continue;
    const glm::dvec3 origin = chunk.origin_m - camera.eye_m;
    const glm::dvec3 detail = chunk.origin_m - glm::floor(chunk.origin_m / 1024.0) * 1024.0;
    items.push_back({&chunk, {glm::vec4(glm::vec3(origin), 0.0f), glm::vec4(glm::vec3(detail), static_cast<float>(chunk.material))},
                     static_cast<float>(distance)});
  }
  std::sort(items.begin(), items.end(), [&](const DrawItem& a, const DrawItem& b) {
    auto kind = [&](const DrawItem& item) {
      const SceneMaterial& material = materials[item.chunk->material];
      return std::tuple(material.retroreflection_cd_per_lx_m2 > 0.0f, material.surface, material.double_sided);
    };
    return std::tuple(kind(a), a.distance_m, a.chunk->first_index) < std::tuple(kind(b), b.distance_m, b.chunk->first_index);
  });
  return items;
}

}  // namespace phare
