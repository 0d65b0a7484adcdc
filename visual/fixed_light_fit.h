// Light at the vertices of a scene that stands, such that what is drawn between them is nearest to what falls there.
//
// A shadow of a pole or a sill is narrower than the sides that light is kept along. Kept as it is at the vertices, such
// a shadow is a blotch as wide as a side where it meets a vertex and nothing where it does not. Here it darkens what
// lies around it by its share: least squares over the area, of functions that are linear on each triangle. The steps
// are Jacobi's with the mass matrix lumped, whose eigenvalues lie in (0, 1]: each step comes nearer, none overshoots
// the solution of a smooth remainder, and light that the vertices already keep exactly stays.
#pragma once

#include <array>
#include <vector>

#include "visual/fixed_light.h"

namespace phare {

/// Changes the light of meshes that FixedLight cut; corners at one place, of one normal and material are one, in
/// whatever chunks. On all cores; the same light however many. 2 million places are asked at most, and meshes of more
/// than 4 million corners together keep the light of their corners. Errors: docs/street-lamps.md.
/// `least_edges_m`: how short sides are cut, of the mesh near by and those of kFarLevels.
void fit_light(const FixedLight& light, const Scene& scene, std::vector<FixedLight::Meshes>& meshes,
               const std::array<double, 1 + kFarLevels.size()>& least_edges_m);

}  // namespace phare
