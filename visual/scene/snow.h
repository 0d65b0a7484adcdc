// Snow that lies, as the picture has it (shaders/lib/snow.h), for what is told of a point.
#pragma once

#include <glm/vec3.hpp>

namespace phare {

/// Share of a surface that is covered, where `cover_01` of level ground is. `normal`: unit, of the side that is seen.
double snow_share(const glm::dvec3& normal, double cover_01);

/// Of snow, linear Rec. 709.
glm::dvec3 snow_reflectance();

}  // namespace phare
