// Normal and roughness textures of glTF 2.0 (3.9.3, 3.9.2) made ready for the device: levels of detail that keep what
// light makes of them.
//
// A level's texel is the mean of the normals it stands for, which is shorter than 1 the more they differ. A surface's
// light is linear in its normal, so of many facets it is that of their mean; and they spread a mirrored lamp as slopes
// of mean square 2(1 - r)/r do, r being its length (Toksvig 2005, "Mipmapping normal maps", with alpha² = 2/(s + 2) of
// Walter et al. 2007). Roughness is averaged as mean square of slopes, alpha² = roughness⁴; metal as it is. What shaders
// do with it: shaders/lib/relief.glsl. Checked by tests/scene/relief_test.cpp.
#pragma once

#include <cstdint>
#include <glm/gtc/type_precision.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "visual/scene/texture.h"

namespace phare {

/// Of a normal texture. Half floats: low light on a road asks for a tilt of 0.02°, which 255 steps do not have.
struct NormalLevel {
  std::uint32_t width = 0, height = 0;
  /// x, y of the mean normal; the level's slopes, below, the same all over; 1 - r, how much shorter than 1 it is.
  std::vector<glm::u16vec4> texels{};

  glm::vec3 mean_at(std::uint32_t x, std::uint32_t y) const;
  float slopes() const;
};

/// Of a texture as the file has it, whole and halved down to one texel; x and y of its normals times `scale`.
/// Slopes are alpha² of the Gaussian ones that have a level's light at grazing angles: of its facets, between texels too,
/// that is mean(|n_xy|)/(pi·mean(n_z)), of Gaussian ones alpha/(2·√pi).
/// A texture that leans by less than 1.5 of 255 steps as a whole (level is 127.5, files say 127 or 128) leans not at all.
/// `nearest`: nothing is seen between texels.
std::vector<NormalLevel> normal_levels(const SceneTexture& texture, float scale, bool nearest = false);

/// Of a texture of roughness (green) and metal (blue).
std::vector<SceneTexture> rough_levels(const SceneTexture& texture);

}  // namespace phare
