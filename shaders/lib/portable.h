// Lets the pure functions of shaders/lib compile as GLSL and as C++ (through GLM), so that tests call the very same text.
#ifndef PHARE_SHADERS_LIB_PORTABLE_H
#define PHARE_SHADERS_LIB_PORTABLE_H

#ifdef __cplusplus
#include <glm/glm.hpp>
#define PHARE_INLINE inline
namespace phare::shader {
using glm::abs;
using glm::clamp;
using glm::cos;
using glm::cross;
using glm::dot;
using glm::exp;
using glm::floor;
using glm::length;
using glm::log;
using glm::log2;
using glm::max;
using glm::min;
using glm::mix;
using glm::mod;
using glm::sin;
using glm::smoothstep;
using glm::sqrt;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using uint = unsigned int;
}  // namespace phare::shader
#define PHARE_SHADER_BEGIN namespace phare::shader {
#define PHARE_SHADER_END }
#else
#define PHARE_INLINE
#define PHARE_SHADER_BEGIN
#define PHARE_SHADER_END
#endif

#endif
