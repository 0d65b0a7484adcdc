#include "visual/scene/world.h"

#include <map>
#include <string>

namespace phare {

std::vector<std::vector<std::size_t>> chunks_by_node(const Scene& scene) {
  std::map<std::string, std::size_t> known;
  std::vector<std::vector<std::size_t>> nodes;
  for (std::size_t i = 0; i < scene.chunks.size(); ++i) {
    const auto [found, fresh] = known.try_emplace(scene.chunks[i].node, nodes.size());
    if (fresh) nodes.emplace_back();
    nodes[found->second].push_back(i);
  }
  return nodes;
}

World World::without(std::size_t moving) const {
  World rest = *this;
  if (moving < rest.moving_.size()) rest.moving_.erase(rest.moving_.begin() + static_cast<std::ptrdiff_t>(moving));
  return rest;
}

}  // namespace phare
