// Pictures on surfaces: decoded, kept within bounds, made smaller for their distances in linear light.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <string>
#include <vector>

#include "config/base/result.h"

namespace phare {

enum class TextureWrap : std::uint8_t { kRepeat, kMirror, kClamp };

/// How texels become a value between them, as glTF's samplers have it.
struct TextureSampler {
  TextureWrap across = TextureWrap::kRepeat, down = TextureWrap::kRepeat;
  bool nearest = false;  ///< texels with sharp edges, near by

  friend auto operator<=>(const TextureSampler&, const TextureSampler&) = default;
};

/// Rows from the top; rgb as sRGB (IEC 61966-2-1), alpha as it is.
struct SceneTexture {
  std::string name;
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};

/// A picture larger than this is halved until it fits: what it shows of a surface of 10 m is finer than 3 mm.
inline constexpr std::uint32_t kMostTextureSide = 4096;

/// PNG or JPEG. Error: the reason; `name` is its place.
Result<SceneTexture> decode_texture(std::span<const unsigned char> bytes, const std::string& name);

/// Linear value of an sRGB byte.
float linear_of_srgb_byte(std::uint8_t byte);

/// Half as large each way (at least 1), averaged in linear light, colours weighted by their opacity.
SceneTexture halved(const SceneTexture& texture);

/// Of another size, each texel from the four nearest.
SceneTexture resized(const SceneTexture& texture, std::uint32_t width, std::uint32_t height);

/// Mean of what can be seen of it: linear rgb, weighted by opacity; w: mean opacity.
glm::vec4 mean_of(const SceneTexture& texture);

/// At a place, 0 to 1 from the left and from the top, wrapped by the sampler, between the nearest four texels: linear
/// rgb and opacity. In float64, as the device does it near by.
glm::dvec4 texel_at(const SceneTexture& texture, const TextureSampler& sampler, glm::dvec2 uv);

}  // namespace phare
