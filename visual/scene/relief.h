// Normal and roughness textures of glTF 2.0 (3.9.3, 3.9.2) made ready for the device: levels of detail that keep what
// light makes of them.
//
// A level's texel is the mean of the normals it stands for, as a direction and how long that mean is, r. A surface's
// light is linear in its normal, so of many facets it is that of their mean, r times that of the direction; and they
// spread a mirrored lamp as slopes of mean square 2(1 - r)/r do (Toksvig 2005, "Mipmapping normal maps", with
// alpha² = 2/(s + 2) of Walter et al. 2007). Roughness is averaged as mean square of slopes, alpha² = roughness⁴; metal
// as it is. What shaders do with it: shaders/lib/relief.glsl. Checked by tests/scene/relief_test.cpp.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "visual/scene/texture.h"

namespace phare {

/// A texel of a normal texture: rgb the direction in 255 steps of -1 to 1, a: the root of 1 - r, so that a shortening of
/// 1.5e-5 is kept.
struct MeanNormal {
  glm::vec3 mean{0.0f, 0.0f, 1.0f};  ///< no longer than 1
};
MeanNormal mean_normal_at(const SceneTexture& texture, std::uint32_t x, std::uint32_t y);

/// Of a texture as the file has it, whole and halved down to one texel; x and y of its normals times `scale`.
std::vector<SceneTexture> normal_levels(const SceneTexture& texture, float scale);

/// Of a whole normal texture, x and y times `scale`.
struct Slopes {
  float mean_square = 0.0f;  ///< both ways together: alpha² of its facets
  /// Of the Gaussian slopes that light at a grazing angle takes its facets for: there they have mean(|n_xy|)/π of it,
  /// Gaussian ones alpha/(2·√π). Of a Gaussian texture, small slopes, it is mean_square.
  float grazing = 0.0f;
};
Slopes slopes_of(const SceneTexture& texture, float scale);

/// Of a texture of roughness (green) and metal (blue).
std::vector<SceneTexture> rough_levels(const SceneTexture& texture);

}  // namespace phare
