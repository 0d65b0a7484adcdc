#include "tools/scene_shadows.h"

#include <cassert>

#include "config/base/on_all_cores.h"
#include "visual/scene/ray_hit.h"

namespace phare {

std::vector<HiddenBy> take_shadows(const Scene& scene, std::span<const glm::dvec3> lamps_m,
                                   std::span<const PointRow> points, std::span<Illuminance> measured) {
  assert(measured.size() == points.size());
  const World world(scene);
  std::vector<HiddenBy> hidden(points.size(), HiddenBy(lamps_m.size()));
  on_all_cores(points.size(), [&](std::size_t i) {
    Illuminance& at = measured[i];
    at.total_lx = 0.0;
    for (std::size_t lamp = 0; lamp < lamps_m.size(); ++lamp) {
      const SceneChunk* by = at.lamps_lx[lamp] > 0.0 ? occluder(world, lamps_m[lamp], points[i].position_m) : nullptr;
      if (by != nullptr) {
        at.lamps_lx[lamp] = 0.0;
        hidden[i][lamp] = name_of(*by);
      }
      at.total_lx += at.lamps_lx[lamp];
    }
  });
  return hidden;
}

}  // namespace phare
