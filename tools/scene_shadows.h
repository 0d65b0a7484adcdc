// What a scene leaves of the light of lamps at points: `phare measure --scene`.
//
// A lamp is a point, and lights a point or does not: the ray between them against every triangle that stands, in
// float64 (occluder() of visual/scene/ray_hit.h), as for probes and clicks of a drive. Left out: what is reflected;
// openings of lamps, whose shadows have soft edges in the picture. Checked by tests/tools/measure_scene_test.cpp.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "visual/photometry/readers/points_file.h"
#include "visual/photometry/table/illuminance.h"
#include "visual/scene/scene.h"

namespace phare {

/// Takes from `measured`, a row for each point as if nothing stood anywhere, the light of lamps that are hidden, and
/// sums what is left in the lamps' order. `lamps_m`: world, in the order of Illuminance::lamps_lx. Returns what hides
/// each lamp, by its node, nearest to the point; empty also where a lamp sends nothing there. On all cores.
std::vector<HiddenBy> take_shadows(const Scene& scene, std::span<const glm::dvec3> lamps_m,
                                   std::span<const PointRow> points, std::span<Illuminance> measured);

}  // namespace phare
