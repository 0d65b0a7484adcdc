#include "visual/scene/relief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace phare {
namespace {

/// A steeper one counts as so steep: 84°.
constexpr float kLeastUp = 0.1f;

std::uint8_t unorm_byte(float value_01) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value_01, 0.0f, 1.0f) * 255.0f));
}

const std::uint8_t* texel(const SceneTexture& texture, std::uint32_t x, std::uint32_t y) {
  return &texture.rgba[4 * (std::size_t{std::min(y, texture.height - 1)} * texture.width +
                            std::min(x, texture.width - 1))];
}

glm::vec3 direction_of(const std::uint8_t* rgb) {
  return glm::vec3(rgb[0], rgb[1], rgb[2]) * (2.0f / 255.0f) - 1.0f;
}

/// glTF 2.0, 3.9.3: normalize((2·sample - 1)·(scale, scale, 1)); what points into the surface counts as along it.
glm::vec3 unit_normal(const std::uint8_t* rgb, float scale) {
  glm::vec3 normal = direction_of(rgb) * glm::vec3(scale, scale, 1.0f);
  normal.z = std::max(normal.z, 0.0f);
  const float length = glm::length(normal);
  return length > 1e-3f ? normal / length : glm::vec3(0.0f, 0.0f, 1.0f);
}

void put_mean(std::uint8_t* rgba, const glm::vec3& mean) {
  const float r = std::min(glm::length(mean), 1.0f);
  const glm::vec3 direction = r > 1e-6f ? mean / r : glm::vec3(0.0f, 0.0f, 1.0f);
  for (int c = 0; c < 3; ++c) rgba[c] = unorm_byte(0.5f + 0.5f * direction[c]);
  rgba[3] = unorm_byte(std::sqrt(std::max(1.0f - r, 0.0f)));
}

template <typename Put>
SceneTexture half_of(const SceneTexture& texture, const Put& put) {
  SceneTexture half{texture.name, std::max(texture.width / 2, 1u), std::max(texture.height / 2, 1u), {}};
  half.rgba.resize(4 * std::size_t{half.width} * half.height);
  for (std::uint32_t y = 0; y < half.height; ++y)
    for (std::uint32_t x = 0; x < half.width; ++x)
      put(&half.rgba[4 * (std::size_t{y} * half.width + x)], 2 * x, 2 * y);
  return half;
}

}  // namespace

MeanNormal mean_normal_at(const SceneTexture& texture, std::uint32_t x, std::uint32_t y) {
  const std::uint8_t* rgba = texel(texture, x, y);
  const float short_of = static_cast<float>(rgba[3]) / 255.0f;
  return {glm::normalize(direction_of(rgba)) * (1.0f - short_of * short_of)};
}

std::vector<SceneTexture> normal_levels(const SceneTexture& texture, float scale) {
  std::vector<SceneTexture> levels{texture};
  for (std::size_t i = 0; i < levels[0].rgba.size(); i += 4)
    put_mean(&levels[0].rgba[i], unit_normal(&texture.rgba[i], scale));
  // What rounding to bytes takes of a direction's length is not what facets take.
  for (std::size_t i = 3; i < levels[0].rgba.size(); i += 4) levels[0].rgba[i] = 0;
  while (levels.back().width > 1 || levels.back().height > 1) {
    const SceneTexture& whole = levels.back();
    levels.push_back(half_of(whole, [&](std::uint8_t* rgba, std::uint32_t x, std::uint32_t y) {
      glm::vec3 sum(0.0f);
      for (const std::uint32_t dy : {0u, 1u})
        for (const std::uint32_t dx : {0u, 1u}) sum += mean_normal_at(whole, x + dx, y + dy).mean;
      put_mean(rgba, 0.25f * sum);
    }));
  }
  return levels;
}

Slopes slopes_of(const SceneTexture& texture, float scale) {
  double square = 0.0, flat = 0.0;
  for (std::size_t i = 0; i < texture.rgba.size(); i += 4) {
    const glm::vec3 normal = unit_normal(&texture.rgba[i], scale);
    const float up = std::max(normal.z, kLeastUp), along2 = normal.x * normal.x + normal.y * normal.y;
    square += static_cast<double>(along2 / (up * up));
    flat += static_cast<double>(std::sqrt(along2));
  }
  const double texels = static_cast<double>(texture.rgba.size()) / 4.0, mean = flat / texels;
  return {static_cast<float>(square / texels), static_cast<float>(4.0 / std::numbers::pi * mean * mean)};
}

std::vector<SceneTexture> rough_levels(const SceneTexture& texture) {
  static const std::array<float, 256> fourth = [] {
    std::array<float, 256> powers{};
    for (std::size_t i = 0; i < powers.size(); ++i) powers[i] = std::pow(static_cast<float>(i) / 255.0f, 4.0f);
    return powers;
  }();
  std::vector<SceneTexture> levels{texture};
  while (levels.back().width > 1 || levels.back().height > 1) {
    const SceneTexture& whole = levels.back();
    levels.push_back(half_of(whole, [&](std::uint8_t* rgba, std::uint32_t x, std::uint32_t y) {
      float slopes = 0.0f, metal = 0.0f;
      for (const std::uint32_t dy : {0u, 1u})
        for (const std::uint32_t dx : {0u, 1u}) {
          const std::uint8_t* from = texel(whole, x + dx, y + dy);
          slopes += 0.25f * fourth[from[1]];
          metal += 0.25f * static_cast<float>(from[2]) / 255.0f;
        }
      rgba[0] = rgba[3] = 255;
      rgba[1] = unorm_byte(std::sqrt(std::sqrt(slopes)));
      rgba[2] = unorm_byte(metal);
    }));
  }
  return levels;
}

}  // namespace phare
