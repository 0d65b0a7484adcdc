#include "visual/reference_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/matrix.hpp>
#include <numbers>

#include "visual/lit_scene.h"

namespace phare {
namespace {

constexpr std::uint32_t kBuffers = 5;
constexpr vk::DeviceSize kPlaceBytes = sizeof(double) * shader::kReferenceViewWords;
static_assert(kPlaceBytes % 256 == 0);  // the most that a device may ask of a dynamic offset
static_assert(shader::kReferenceLampWords * shader::kMaxLamps == shader::kReferenceEyeFromClip);
static_assert(sizeof(GpuVertex) == 4 * shader::kReferenceVertexWords);

std::array<vk::DescriptorSetLayoutBinding, kBuffers> reference_bindings() {
  std::array<vk::DescriptorSetLayoutBinding, kBuffers> bindings;
  for (std::uint32_t i = 0; i < kBuffers; ++i)
    bindings[i] = {
        .binding = i,
        .descriptorType = i == 0 ? vk::DescriptorType::eStorageBufferDynamic : vk::DescriptorType::eStorageBuffer,
        .descriptorCount = 1,
        .stageFlags = vk::ShaderStageFlagBits::eFragment};
  return bindings;
}

/// Grows where it has to; what it held is lost then.
void make_room(gpu::Device& device, gpu::HostBuffer& buffer, std::size_t words, const char* name) {
  const vk::DeviceSize bytes = sizeof(double) * std::max<std::size_t>(words, 1);
  if (buffer.bytes < bytes) buffer = gpu::HostBuffer(device, bytes, vk::BufferUsageFlagBits::eStorageBuffer, name);
}

/// Axes of the image (columns, in its frame) that the rows a, b, c of the shader are, and the table's kind.
struct TableAxes {
  glm::dmat3 rows;
  std::uint32_t kind;
};
TableAxes axes_of(const BeamImage& image) {
  const glm::dvec3 forward(1, 0, 0), right(0, -1, 0), up(0, 0, 1);
  if (image.screen_distance_m > 0.0) return {{forward, right, up}, shader::kReferenceScreen};
  if (image.type == PhotometricType::kA) return {{forward, right, up}, shader::kReferenceAngles};
  if (image.type == PhotometricType::kB) return {{forward, up, right}, shader::kReferenceAngles};
  if (image.axis == GammaAxis::kGamma0) return {{right, up, -forward}, shader::kReferenceTurn};
  return {{forward, -right, up}, shader::kReferenceTurn};
}

}  // namespace

std::optional<std::string> no_reference(const gpu::Device& device) {
  std::string lacks;
  if (!device.float64) lacks = "shaderFloat64";
  if (!device.primitive_id) lacks += std::string(lacks.empty() ? "" : " and ") + "geometryShader (gl_PrimitiveID)";
  if (lacks.empty()) return std::nullopt;
  return "the device has no " + lacks + ", and nothing less is float64; fragment is the next exact (docs/accuracy.md)";
}

std::vector<double> reference_table(const BeamImage& image) {
  if (image.dark || image.first_deg.size() < 2 || image.second_deg.size() < 2) return {};
  const bool transposed = image.type == PhotometricType::kB && image.screen_distance_m <= 0.0;
  const bool screen = image.screen_distance_m > 0.0;
  std::vector<double> first = image.first_deg, second = image.second_deg;
  if (transposed) std::swap(first, second);
  if (screen)
    for (std::vector<double>* nodes : {&first, &second})
      for (double& node : *nodes) node = std::tan(node * std::numbers::pi / 180.0);
  std::vector<double> words{static_cast<double>(first.size()), static_cast<double>(second.size()),
                            static_cast<double>(axes_of(image).kind), image.tints.empty() ? 0.0 : 1.0};
  words.insert(words.end(), first.begin(), first.end());
  words.insert(words.end(), second.begin(), second.end());
  const auto add = [&](const auto& value_of) {
    for (std::size_t j = 0; j < second.size(); ++j)
      for (std::size_t i = 0; i < first.size(); ++i) {
        const std::size_t node = transposed ? i * second.size() + j : j * first.size() + i;
        words.push_back(value_of(node) / (screen ? screen_factor(first[i], second[j]) : 1.0));
      }
  };
  add([&](std::size_t node) { return static_cast<double>(image.candela[node]); });
  if (image.tints.empty()) return words;
  add([&](std::size_t node) { return static_cast<double>(image.tints[node].x); });
  add([&](std::size_t node) { return static_cast<double>(image.tints[node].y); });
  return words;
}

ReferenceLight::ReferenceLight(gpu::Device& device) : device_(device), sets_(device, reference_bindings()) {}

void ReferenceLight::begin_frame(std::span<const BeamImage> images, std::span<const std::uint64_t> versions,
                                 const SceneBuffers& geometry) {
  used_ = 0;
  vertices_ = *geometry.vertices.buffer;
  indices_ = *geometry.indices.buffer;
  if (!std::ranges::equal(versions, versions_)) {
    upload_tables(images);
    versions_.assign(versions.begin(), versions.end());
  }
  make_room(device_, tables_, 0, "reference tables");
  make_room(device_, points_, 0, "reference points");
  for (const Page& page : pages_) point_to_buffers(page);
}

void ReferenceLight::upload_tables(std::span<const BeamImage> images) {
  std::vector<double> words;
  table_at_.clear();
  rows_.clear();
  for (const BeamImage& image : images) {
    table_at_.push_back(words.size());
    rows_.push_back(axes_of(image).rows);
    const std::vector<double> table = reference_table(image);
    words.insert(words.end(), table.begin(), table.end());
  }
  make_room(device_, tables_, words.size(), "reference tables");
  std::memcpy(tables_.data, words.data(), sizeof(double) * words.size());
}

void ReferenceLight::set_points(std::span<const double> points) {
  make_room(device_, points_, points.size(), "reference points");
  std::memcpy(points_.data, points.data(), points.size_bytes());
  for (const Page& page : pages_) point_to_buffers(page);
}

void ReferenceLight::point_to_buffers(const Page& page) {
  const std::array<vk::DescriptorBufferInfo, kBuffers> infos{
      vk::DescriptorBufferInfo{*page.words.buffer, 0, kPlaceBytes},
      vk::DescriptorBufferInfo{*tables_.buffer, 0, VK_WHOLE_SIZE},
      vk::DescriptorBufferInfo{vertices_, 0, VK_WHOLE_SIZE}, vk::DescriptorBufferInfo{indices_, 0, VK_WHOLE_SIZE},
      vk::DescriptorBufferInfo{*points_.buffer, 0, VK_WHOLE_SIZE}};
  std::array<vk::WriteDescriptorSet, kBuffers> writes;
  for (std::uint32_t i = 0; i < kBuffers; ++i)
    writes[i] = {
        .dstSet = page.set,
        .dstBinding = i,
        .descriptorCount = 1,
        .descriptorType = i == 0 ? vk::DescriptorType::eStorageBufferDynamic : vk::DescriptorType::eStorageBuffer,
        .pBufferInfo = &infos[i]};
  device_.device.updateDescriptorSets(writes, nullptr);
}

ReferenceLight::Place ReferenceLight::fill(const LitView& view, const LitBy& lit_by) {
  const std::size_t number = used_++ / kPlacesInPage, place = (used_ - 1) % kPlacesInPage;
  if (number == pages_.size()) {
    pages_.push_back({gpu::HostBuffer(device_, kPlacesInPage * kPlaceBytes, vk::BufferUsageFlagBits::eStorageBuffer,
                                      "reference views"),
                      sets_.make()});
    point_to_buffers(pages_.back());
  }
  std::array<double, shader::kReferenceViewWords> words{};
  for (std::size_t i = 0; i < lit_by.lamps; ++i) {
    const PlacedLamp& lamp = view.lit_lamps[lit_by.lamp_at[i]];
    double* out = words.data() + i * shader::kReferenceLampWords;
    const glm::dvec3 from_eye_m = lamp.position_m - view.geometry.camera().eye_m;
    const glm::dmat3 rows = lamp.world_from_image * rows_[lamp.beam];
    for (int k = 0; k < 3; ++k) {
      out[k] = from_eye_m[k];
      for (int row = 0; row < 3; ++row) out[3 + 3 * row + k] = rows[row][k];
    }
    out[shader::kReferenceTableAt] = static_cast<double>(table_at_[lamp.beam]);
  }
  const glm::dmat4 eye_from_clip = glm::inverse(view.geometry.clip_from_eye());
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      words[shader::kReferenceEyeFromClip + static_cast<std::size_t>(4 * column + row)] = eye_from_clip[column][row];
  const std::array area{static_cast<double>(view.area.offset.x), static_cast<double>(view.area.offset.y),
                        static_cast<double>(view.area.extent.width), static_cast<double>(view.area.extent.height)};
  std::ranges::copy(area, words.begin() + shader::kReferenceArea);
  std::memcpy(static_cast<std::byte*>(pages_[number].words.data) + place * kPlaceBytes, words.data(), kPlaceBytes);
  return {pages_[number].set, static_cast<std::uint32_t>(place * kPlaceBytes)};
}

}  // namespace phare
