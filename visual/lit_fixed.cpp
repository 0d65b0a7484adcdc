// The lit scene under light that does not change (visual/fixed_light.h): its pipelines, and what they read beside the
// vertices. A scene without such light has none of it.
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <numbers>

#include "visual/lit_scene.h"
#include "visual/passes/fixed_shaders.h"

namespace phare {

namespace {

constexpr std::uint32_t kRoadAt = 4;  // behind all buffers of what is textured

static_assert(sizeof(FixedVertex) == 20 && offsetof(FixedVertex, sky_share) == 16);
static_assert(sizeof(FixedRoad) == 48);
static_assert(sizeof(FixedProbe) == 32 && offsetof(FixedProbe, way) == 16 && offsetof(FixedProbe, sky_share) == 28);

// As kVertexAttributes, which may not be there yet when these are made.
vk::VertexInputAttributeDescription of_vertex(std::uint32_t location, vk::Format format, std::uint32_t offset) {
  return {.location = location, .binding = 0, .format = format, .offset = offset};
}

vk::VertexInputAttributeDescription beside(std::uint32_t location, vk::Format format, std::uint32_t offset) {
  return {.location = location, .binding = 1, .format = format, .offset = offset};
}

}  // namespace

const std::array<vk::VertexInputAttributeDescription, 6> kFixedAttributes{
    of_vertex(0, vk::Format::eR32G32B32Sfloat, 0), of_vertex(1, vk::Format::eR32G32B32Sfloat, 12),
    of_vertex(2, vk::Format::eR32Uint, 24),        beside(3, vk::Format::eR32G32B32A32Sfloat, 0),
    beside(4, vk::Format::eR32Sfloat, 16),         beside(5, vk::Format::eR32Sfloat, 16)};  // not read of what stands

const std::array<vk::VertexInputAttributeDescription, 6> kProbeAttributes{
    of_vertex(0, vk::Format::eR32G32B32Sfloat, 0), of_vertex(1, vk::Format::eR32G32B32Sfloat, 12),
    of_vertex(2, vk::Format::eR32Uint, 24),        beside(3, vk::Format::eR32G32B32A32Sfloat, 0),
    beside(4, vk::Format::eR32Sfloat, 28),         beside(5, vk::Format::eR32G32B32Sfloat, 16)};

LitScene::Code LitScene::fixed_vertex(const LitVariant& variant, std::size_t size) const {
  const bool fog = variant.fog.slices != 0, road = variant.kind.road;
  const bool by_vertex = variant.method != Method::kFragment && variant.method != Method::kReference;
  return road ? road_vert(size, by_vertex, filtered(), fog) : fixed_vert(size, by_vertex, filtered(), fog);
}

void LitScene::add_fixed_light(LitView& view) {
  view.fixed_light = true;
  if (const auto moon = fixed_light_->moon_toward()) {
    // E on a plane that faces it is L times the disc's solid angle.
    const double steradians = 2.0 * std::numbers::pi * (1.0 - std::cos(kMoonRadius_rad));
    view.sky.moon = MoonDisc{moon->toward, moon->colour * static_cast<float>(moon->lx / steradians)};
  }
  add_mirrored(view);
  auto& probes = written_->probes;
  std::size_t& used = written_->probes_used;
  view.first_probe = used;
  for (const PlacedMesh& mesh : view.moving) {
    const std::size_t page = used / kProbesInPage, place = used % kProbesInPage;
    if (page == probes.size())
      probes.push_back(std::make_unique<gpu::HostBuffer>(
          device_, kProbesInPage * sizeof(FixedProbe), vk::BufferUsageFlagBits::eVertexBuffer, "light on what moves"));
    // At the middle of its bounds, where light passes over the road and under roofs.
    glm::dvec3 low_m(0.0), high_m(0.0);
    bool begun = false;
    if (mesh.mesh >= geometry_.moving.size()) {  // nothing of it is drawn; its place is counted
      ++used;
      continue;
    }
    for (const SceneBatch& batch : geometry_.moving[mesh.mesh].batches) {
      low_m = begun ? glm::min(low_m, batch.low_m) : batch.low_m;
      high_m = begun ? glm::max(high_m, batch.high_m) : batch.high_m;
      begun = true;
    }
    static_cast<FixedProbe*>(probes[page]->data)[place] =
        fixed_light_->probe(mesh.position_m + mesh.world_from_mesh * (0.5 * (low_m + high_m)));
    ++used;
  }
}

void LitScene::add_mirrored(const LitView& view) {
  if (!view.wet) return;
  const glm::dvec3& eye_m = view.geometry.camera().eye_m;
  const std::vector<FixedLight::Mirrored> lamps = fixed_light_->mirrored_into(eye_m, shader::kMirroredLamps);
  for (const LitBy& lit : view.lit_by)
    for (std::size_t i = 0; i < lamps.size(); ++i) {
      lit.data->mirrored_at[i] = glm::vec4(glm::vec3(lamps[i].place_m - eye_m), 0.0f);
      lit.data->mirrored_cd[i] = glm::vec4(lamps[i].cd, 0.0f);
    }
}

void LitScene::bind_fixed_light(gpu::Recorder& commands, const LitView& view, const DrawItem& item,
                                vk::Buffer& bound) const {
  vk::Buffer wanted = *geometry_.fixed_light.buffer;
  if (item.moves != DrawItem::kStands) wanted = *written_->probes[(view.first_probe + item.moves) / kProbesInPage]->buffer;
  if (wanted != bound) commands.bindVertexBuffers(1, bound = wanted, vk::DeviceSize{0});
}

void LitScene::bind_road(gpu::Recorder& commands, const SceneBatch& batch) const {
  const auto first = static_cast<vk::DeviceSize>(batch.first_vertex);
  if (batch.kind.look == 0) {
    const std::array buffers{*geometry_.vertices.buffer, *geometry_.fixed_light.buffer};
    const std::array<vk::DeviceSize, 2> offsets{first * sizeof(GpuVertex), first * sizeof(FixedVertex)};
    commands.bindVertexBuffers(0, buffers, offsets);
  }
  commands.bindVertexBuffers(kRoadAt, *geometry_.road.buffer,
                             static_cast<vk::DeviceSize>(batch.first_road) * sizeof(FixedRoad));
}

/// As shaders/scene.vert has them.
void LitScene::add_road_vertices(PipelineRecipe& recipe,
                                 std::vector<vk::VertexInputAttributeDescription>& attributes) {
  constexpr std::uint32_t kFirst = 12, kWords = 4;
  for (std::uint32_t i = 0; i < sizeof(FixedRoad) / (4 * kWords); ++i)
    attributes.push_back({.location = kFirst + i,
                          .binding = kRoadAt,
                          .format = vk::Format::eR32G32B32A32Uint,
                          .offset = 4 * kWords * i});
  recipe.fifth_stride = sizeof(FixedRoad);
  recipe.attributes = attributes;
}

std::uint32_t LitScene::probe_in_page(const LitView& view, const DrawItem& item) {
  return static_cast<std::uint32_t>((view.first_probe + item.moves) % kProbesInPage);
}

}  // namespace phare
