#include "visual/scene/texture.h"

#include <stb_image.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec3.hpp>
#include <memory>

#include "visual/image/srgb.h"

namespace phare {
namespace {

/// Pixels of a picture that is still read, to be halved: 1 GiB.
constexpr std::int64_t kMostPixels = std::int64_t{1} << 28;

std::uint8_t byte_of(float value_01) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value_01, 0.0f, 1.0f) * 255.0f));
}

/// By a table of 4096 steps: of dark ones several are one byte, of light ones a step is a quarter of a byte.
std::uint8_t srgb_byte_of(float linear) {
  static const std::array<std::uint8_t, 4097> table = [] {
    std::array<std::uint8_t, 4097> bytes{};
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      const double c = static_cast<double>(i) / 4096.0;
      bytes[i] = byte_of(static_cast<float>(c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055));
    }
    return bytes;
  }();
  return table[static_cast<std::size_t>(std::lround(std::clamp(linear, 0.0f, 1.0f) * 4096.0f))];
}

glm::vec4 linear_at(const SceneTexture& texture, std::uint32_t x, std::uint32_t y) {
  const std::uint8_t* texel = &texture.rgba[4 * (std::size_t{y} * texture.width + x)];
  const auto& linear = linear_of_srgb();
  return {linear[texel[0]], linear[texel[1]], linear[texel[2]], static_cast<float>(texel[3]) / 255.0f};
}

void put(SceneTexture& texture, std::uint32_t x, std::uint32_t y, const glm::vec4& linear) {
  std::uint8_t* texel = &texture.rgba[4 * (std::size_t{y} * texture.width + x)];
  for (int c = 0; c < 3; ++c) texel[c] = srgb_byte_of(linear[c]);
  texel[3] = byte_of(linear.w);
}

/// Colours by their opacity; where nothing can be seen, as they are.
glm::vec4 mean_of_four(const std::array<glm::vec4, 4>& four, const std::array<float, 4>& weights) {
  glm::vec3 seen(0.0f), all(0.0f);
  float opacity = 0.0f;
  for (std::size_t i = 0; i < four.size(); ++i) {
    seen += glm::vec3(four[i]) * (four[i].w * weights[i]);
    all += glm::vec3(four[i]) * weights[i];
    opacity += four[i].w * weights[i];
  }
  return glm::vec4(opacity > 0.0f ? seen / opacity : all, opacity);
}

std::int64_t wrapped(std::int64_t i, std::int64_t size, TextureWrap wrap) {
  if (wrap == TextureWrap::kClamp) return std::clamp<std::int64_t>(i, 0, size - 1);
  const std::int64_t period = wrap == TextureWrap::kMirror ? 2 * size : size;
  const std::int64_t at = ((i % period) + period) % period;
  return at < size ? at : period - 1 - at;
}

}  // namespace

Result<SceneTexture> decode_texture(std::span<const unsigned char> bytes, const std::string& name) {
  const auto size = static_cast<int>(std::min<std::size_t>(bytes.size(), std::size_t{1} << 30));
  int width = 0, height = 0, channels = 0;
  if (size == 0 || stbi_info_from_memory(bytes.data(), size, &width, &height, &channels) == 0)
    return Error{name, "is no PNG or JPEG"};
  if (width < 1 || height < 1 || std::int64_t{width} * height > kMostPixels)
    return Error{name, "has " + std::to_string(width) + " x " + std::to_string(height) + " pixels, more than 2^28"};
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(bytes.data(), size, &width, &height, &channels, 4), stbi_image_free);
  if (!pixels) return Error{name, std::string("cannot be decoded: ") + stbi_failure_reason()};
  SceneTexture texture{name, static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), {}};
  texture.rgba.assign(pixels.get(), pixels.get() + 4 * std::size_t{texture.width} * texture.height);
  while (std::max(texture.width, texture.height) > kMostTextureSide) texture = halved(texture);
  return texture;
}

float linear_of_srgb_byte(std::uint8_t byte) {
  return linear_of_srgb()[byte];
}

SceneTexture halved(const SceneTexture& texture) {
  SceneTexture half{texture.name, std::max(texture.width / 2, 1u), std::max(texture.height / 2, 1u), {}};
  half.rgba.resize(4 * std::size_t{half.width} * half.height);
  for (std::uint32_t y = 0; y < half.height; ++y)
    for (std::uint32_t x = 0; x < half.width; ++x) {
      const std::uint32_t x0 = std::min(2 * x, texture.width - 1), x1 = std::min(2 * x + 1, texture.width - 1);
      const std::uint32_t y0 = std::min(2 * y, texture.height - 1), y1 = std::min(2 * y + 1, texture.height - 1);
      put(half, x, y,
          mean_of_four({linear_at(texture, x0, y0), linear_at(texture, x1, y0), linear_at(texture, x0, y1),
                        linear_at(texture, x1, y1)},
                       {0.25f, 0.25f, 0.25f, 0.25f}));
    }
  return half;
}

SceneTexture resized(const SceneTexture& texture, std::uint32_t width, std::uint32_t height) {
  SceneTexture source = texture;
  while (source.width >= 2 * width && source.height >= 2 * height) source = halved(source);
  SceneTexture out{texture.name, width, height, {}};
  out.rgba.resize(4 * std::size_t{width} * height);
  const TextureSampler clamp{TextureWrap::kClamp, TextureWrap::kClamp, false};
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x)
      put(out, x, y, glm::vec4(texel_at(source, clamp, {(x + 0.5) / width, (y + 0.5) / height})));
  return out;
}

glm::vec4 mean_of(const SceneTexture& texture) {
  glm::dvec3 seen(0.0), all(0.0);
  double opacity = 0.0;
  for (std::uint32_t y = 0; y < texture.height; ++y)
    for (std::uint32_t x = 0; x < texture.width; ++x) {
      const glm::dvec4 texel(linear_at(texture, x, y));
      seen += glm::dvec3(texel) * texel.w;
      all += glm::dvec3(texel);
      opacity += texel.w;
    }
  const double count = static_cast<double>(texture.width) * texture.height;
  return glm::vec4(glm::vec3(opacity > 0.0 ? seen / opacity : all / count), static_cast<float>(opacity / count));
}

glm::dvec4 texel_at(const SceneTexture& texture, const TextureSampler& sampler, glm::dvec2 uv) {
  const glm::dvec2 at(uv.x * texture.width - 0.5, uv.y * texture.height - 0.5);
  const auto texel = [&](double x, double y) {
    return glm::dvec4(linear_at(
        texture, static_cast<std::uint32_t>(wrapped(static_cast<std::int64_t>(x), texture.width, sampler.across)),
        static_cast<std::uint32_t>(wrapped(static_cast<std::int64_t>(y), texture.height, sampler.down))));
  };
  if (sampler.nearest) return texel(std::floor(at.x + 0.5), std::floor(at.y + 0.5));
  const double x = std::floor(at.x), y = std::floor(at.y), part_x = at.x - x, part_y = at.y - y;
  return (texel(x, y) * (1.0 - part_x) + texel(x + 1.0, y) * part_x) * (1.0 - part_y) +
         (texel(x, y + 1.0) * (1.0 - part_x) + texel(x + 1.0, y + 1.0) * part_x) * part_y;
}

}  // namespace phare
