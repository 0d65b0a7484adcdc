#include "visual/scene/relief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>
#include <numbers>

namespace phare {
namespace {

constexpr float kNoLean = 1.5f * 2.0f / 255.0f;

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

/// Mean normals of a level, row by row.
struct Means {
  std::uint32_t width = 0, height = 0;
  std::vector<glm::vec3> at;

  const glm::vec3& of(std::uint32_t x, std::uint32_t y) const {  // beyond the last the first: textures repeat
    return at[std::size_t{y % height} * width + x % width];
  }
};

Means level_of_file(const SceneTexture& texture, float scale) {
  Means means{texture.width, texture.height, {}};
  means.at.reserve(texture.rgba.size() / 4);
  glm::dvec2 lean(0.0);
  for (std::size_t i = 0; i < texture.rgba.size(); i += 4) {
    means.at.push_back(unit_normal(&texture.rgba[i], scale));
    lean += glm::dvec2(means.at.back().x, means.at.back().y);
  }
  const glm::vec2 mean(lean / static_cast<double>(means.at.size()));
  if (std::max(std::abs(mean.x), std::abs(mean.y)) > kNoLean) return means;
  for (glm::vec3& n : means.at) n = glm::normalize(n - glm::vec3(mean, 0.0f));
  return means;
}

Means half_of(const Means& whole) {
  Means half{std::max(whole.width / 2, 1u), std::max(whole.height / 2, 1u), {}};
  half.at.reserve(std::size_t{half.width} * half.height);
  const std::uint32_t right = whole.width > 1 ? 1 : 0, below = whole.height > 1 ? 1 : 0;
  for (std::uint32_t y = 0; y < half.height; ++y)
    for (std::uint32_t x = 0; x < half.width; ++x)
      half.at.push_back(0.25f * (whole.of(2 * x, 2 * y) + whole.of(2 * x + right, 2 * y) +
                                 whole.of(2 * x, 2 * y + below) + whole.of(2 * x + right, 2 * y + below)));
  return half;
}

float slopes_of(const Means& means, bool nearest) {
  double along = 0.0, up = 0.0;
  const auto add = [&](const glm::vec3& n) {
    along += static_cast<double>(std::sqrt(n.x * n.x + n.y * n.y));
    up += static_cast<double>(n.z);
  };
  for (std::uint32_t y = 0; y < means.height; ++y)
    for (std::uint32_t x = 0; x < means.width; ++x) {
      const glm::vec3& a = means.of(x, y);
      if (nearest) {
        add(a);
        continue;
      }
      // At quarters between texels: of edges exactly, of noise 5 % too little.
      const glm::vec3 right = means.of(x + 1, y), below = means.of(x, y + 1), both = means.of(x + 1, y + 1);
      for (const float v : {0.25f, 0.75f})
        for (const float u : {0.25f, 0.75f}) add(glm::mix(glm::mix(a, right, u), glm::mix(below, both, u), v));
    }
  const double slope = along / std::max(up, 1e-3);
  return static_cast<float>(4.0 / std::numbers::pi * slope * slope);
}

NormalLevel packed(const Means& means, bool nearest) {
  NormalLevel level{means.width, means.height, {}};
  level.texels.reserve(means.at.size());
  const float slopes = slopes_of(means, nearest);
  for (const glm::vec3& n : means.at)
    level.texels.push_back(glm::packHalf(glm::vec4(n.x, n.y, slopes, std::max(1.0f - glm::length(n), 0.0f))));
  return level;
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

glm::vec3 NormalLevel::mean_at(std::uint32_t x, std::uint32_t y) const {
  const glm::vec4 texel = glm::unpackHalf(texels[std::size_t{y} * width + x]);
  const float r = 1.0f - texel.w, along2 = texel.x * texel.x + texel.y * texel.y;
  return {texel.x, texel.y, std::sqrt(std::max(r * r - along2, 0.0f))};
}

float NormalLevel::slopes() const {
  return glm::unpackHalf(texels.front()).z;
}

std::vector<NormalLevel> normal_levels(const SceneTexture& texture, float scale, bool nearest) {
  Means means = level_of_file(texture, scale);
  std::vector<NormalLevel> levels{packed(means, nearest)};
  while (means.width > 1 || means.height > 1) {
    means = half_of(means);
    levels.push_back(packed(means, nearest));
  }
  return levels;
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
