#include "visual/passes/grain.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <span>

namespace phare {

namespace {

constexpr std::uint32_t kSize = 512;

// Value noise that repeats after `cells` cells, smooth between them.
std::vector<float> value_noise(std::uint32_t cells, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<float> lattice(cells * cells);
  for (float& value : lattice) value = static_cast<float>(random() >> 8) / 16777216.0f;
  std::vector<float> result(kSize * kSize);
  for (std::uint32_t y = 0; y < kSize; ++y)
    for (std::uint32_t x = 0; x < kSize; ++x) {
      const float u = static_cast<float>(x) * static_cast<float>(cells) / kSize;
      const float v = static_cast<float>(y) * static_cast<float>(cells) / kSize;
      const auto i = static_cast<std::uint32_t>(u), j = static_cast<std::uint32_t>(v);
      auto ease = [](float t) { return t * t * (3.0f - 2.0f * t); };
      const float s = ease(u - static_cast<float>(i)), t = ease(v - static_cast<float>(j));
      auto at = [&](std::uint32_t a, std::uint32_t b) { return lattice[(b % cells) * cells + a % cells]; };
      result[y * kSize + x] =
          std::lerp(std::lerp(at(i, j), at(i + 1, j), s), std::lerp(at(i, j + 1), at(i + 1, j + 1), s), t);
    }
  return result;
}

std::vector<float> sum_of(std::initializer_list<std::pair<std::uint32_t, float>> octaves, std::uint32_t seed) {
  std::vector<float> result(kSize * kSize, 0.0f);
  for (const auto& [cells, weight] : octaves) {
    const std::vector<float> octave = value_noise(cells, seed++);
    for (std::size_t i = 0; i < result.size(); ++i) result[i] += weight * (octave[i] - 0.5f);
  }
  double mean = 0.0;
  for (float value : result) mean += value;
  mean /= static_cast<double>(result.size());
  for (float& value : result) value = std::clamp(value - static_cast<float>(mean) + 0.5f, 0.0f, 1.0f);
  return result;
}

}  // namespace

namespace {

std::vector<float> halved(const std::vector<float>& image, std::uint32_t size) {
  std::vector<float> next((size / 2) * (size / 2));
  for (std::uint32_t y = 0; y < size / 2; ++y)
    for (std::uint32_t x = 0; x < size / 2; ++x) {
      const float* p = &image[2 * y * size + 2 * x];
      next[y * (size / 2) + x] = 0.25f * (p[0] + p[1] + p[size] + p[size + 1]);
    }
  return next;
}

/// A texel a cell: its corners, eight bits each.
void write_cells(std::span<std::uint8_t> texels, const std::vector<float>& image, std::uint32_t size) {
  auto texel = texels.begin();
  for (std::uint32_t y = 0; y < size; ++y)
    for (std::uint32_t x = 0; x < size; ++x) {
      const std::uint32_t right = (x + 1) % size, below = (y + 1) % size;
      for (const std::uint32_t at : {y * size + x, y * size + right, below * size + x, below * size + right})
        *texel++ = static_cast<std::uint8_t>(std::lround(image[at] * 255.0f));
    }
}

/// Texels of a layer from a level on; the first half of it is for the levels after that, each where its own number of
/// texels says (shaders/lib/grain.glsl).
constexpr std::uint32_t layer_texels(std::uint32_t level) {
  return 2 * kSize * kSize >> 2 * level;
}

}  // namespace

Grain make_grain(gpu::Device& device) {
  std::vector<float> fine = sum_of({{256, 0.9f}, {128, 0.4f}, {64, 0.2f}}, 1998);
  std::vector<float> soft = sum_of({{6, 0.8f}, {13, 0.5f}, {31, 0.3f}, {70, 0.2f}}, 1999);
  Grain grain;
  while (2 * layer_texels(grain.first_level) > device.properties.limits.maxTexelBufferElements) ++grain.first_level;
  const std::uint32_t layer = layer_texels(grain.first_level);
  std::vector<std::uint8_t> texels(2 * 4 * layer);
  for (std::uint32_t level = 0; kSize >> level > 0; ++level) {
    const std::uint32_t size = kSize >> level;
    if (level > 0) {
      fine = halved(fine, 2 * size);
      soft = halved(soft, 2 * size);
    }
    if (level < grain.first_level) continue;
    const std::uint32_t begin = size * size;
    write_cells(std::span(texels).subspan(4 * begin), fine, size);
    write_cells(std::span(texels).subspan(4 * (layer + begin)), soft, size);
  }
  grain.texels = gpu::DeviceBuffer(device, std::as_bytes(std::span(texels)),
                                   vk::BufferUsageFlagBits::eUniformTexelBuffer, "grain");
  grain.view = vk::raii::BufferView(
      device.device, vk::BufferViewCreateInfo{
                         .buffer = *grain.texels.buffer, .format = vk::Format::eR8G8B8A8Unorm, .range = VK_WHOLE_SIZE});
  return grain;
}

}  // namespace phare
