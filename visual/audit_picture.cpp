#include "visual/audit_picture.h"

#include <algorithm>
#include <random>

#include "visual/frame.h"
#include "visual/passes/audit.h"

namespace phare {

namespace {

constexpr std::uint32_t kWidth_px = 320;
constexpr vk::DeviceSize kTexelBytes = 16;

vk::Extent2D extent_for(const vk::Extent2D& picture) {
  return {kWidth_px, std::clamp(kWidth_px * picture.height / std::max(picture.width, 1u), 1u, 4 * kWidth_px)};
}

LitView lit_view(LitScene& scene, const ViewInput& view, const vk::Extent2D& extent) {
  const ViewGeometry geometry(view.camera, static_cast<double>(extent.width) / extent.height);
  LitView lit = scene.view(geometry, sky_of(view), view.lamps, view.moving, view.far_mesh_from_m, {}, view.few_kinds);
  lit.method = view.method;
  lit.area = vk::Rect2D{{0, 0}, extent};
  return lit;
}

gpu::HostBuffer copy_of(gpu::Device& device, const vk::Extent2D& extent, const char* name) {
  return {device, kTexelBytes * extent.width * extent.height, vk::BufferUsageFlagBits::eTransferDst, name, true};
}

constexpr vk::ImageUsageFlags kRead = vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc;

}  // namespace

AuditPicture::AuditPicture(gpu::Device& device, const vk::Extent2D& picture)
    : extent_(extent_for(picture)),
      position_(device, kAuditFormat, extent_, kRead, "audit position"),
      normal_(device, kAuditFormat, extent_, kRead, "audit normal"),
      depth_(device, vk::Format::eD32Sfloat, extent_, vk::ImageUsageFlagBits::eDepthStencilAttachment, "audit depth"),
      positions_(copy_of(device, extent_, "audit position copy")),
      normals_(copy_of(device, extent_, "audit normal copy")) {}

void AuditPicture::prepare(LitScene& scene, const ViewInput& view, const vk::Extent2D& picture) {
  scene.prepare(lit_view(scene, view, extent_for(picture)), {.output = LampOutput::kAudit, .format = kAuditFormat});
}

void AuditPicture::draw(gpu::FrameGraph& graph, LitScene& scene, const ViewInput& view) {
  eye_m_ = view.camera.eye_m;
  const LitView lit = lit_view(scene, view, extent_);
  draw_audit(graph, scene, lit, {position_, normal_, depth_});
  graph.read_back(position_, lit.area, positions_);
  graph.read_back(normal_, lit.area, normals_);
}

std::vector<std::size_t> audited_pixels(std::span<const glm::vec4> places, std::span<const glm::vec4> normals,
                                        std::size_t count, std::uint64_t seed) {
  // Light that is missing is among the dark ones, and what is no number is neither lit nor dark.
  std::vector<std::size_t> lit, dark;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (normals[i].w > 0.0f) (places[i].w <= 0.0f ? dark : lit).push_back(i);
  if (lit.empty()) return {};
  std::vector<std::size_t> chosen;
  std::mt19937_64 random(seed);
  for (std::size_t k = 0; k < count; ++k) {
    const std::vector<std::size_t>& from = k % kDarkPixelIn == kDarkPixelIn - 1 && !dark.empty() ? dark : lit;
    chosen.push_back(from[random() % from.size()]);
  }
  return chosen;
}

std::vector<AuditSample> AuditPicture::samples(std::size_t count, std::uint64_t seed) const {
  const std::size_t pixels = std::size_t{extent_.width} * extent_.height;
  const std::span places(static_cast<const glm::vec4*>(positions_.data), pixels);
  const std::span normals(static_cast<const glm::vec4*>(normals_.data), pixels);
  const auto normal_of = [&](std::size_t i) { return glm::dvec3(normals[i]); };
  // How much the normal turns to the next pixels where there is a surface.
  const auto turn_per_px = [&](std::size_t i) {
    double most = 0.0;
    const std::size_t x = i % extent_.width, y = i / extent_.width;
    const auto see = [&](bool there, std::size_t next) {
      if (there && normals[next].w > 0.0f) most = std::max(most, glm::distance(normal_of(next), normal_of(i)));
    };
    see(x > 0, i - 1), see(x + 1 < extent_.width, i + 1);
    see(y > 0, i - extent_.width), see(y + 1 < extent_.height, i + extent_.width);
    return most;
  };
  std::vector<AuditSample> samples;
  for (const std::size_t i : audited_pixels(places, normals, count, seed))
    samples.push_back({{eye_m_ + glm::dvec3(places[i]), normal_of(i)},
                       static_cast<double>(places[i].w),
                       (static_cast<double>(i % extent_.width) + 0.5) / extent_.width,
                       (static_cast<double>(i / extent_.width) + 0.5) / extent_.height,
                       4.0 * 0x1p-24 * static_cast<double>(i % extent_.width + i / extent_.width) * turn_per_px(i)});
  return samples;
}

}  // namespace phare
