#include "visual/process/movers.h"

#include <algorithm>

#include "config/base/paths.h"
#include "visual/scene/world.h"

namespace phare {

Result<Movers> Movers::read() {
  auto meshes = read_scene(generated_dir() / "scenes/road_users.glb");
  if (!meshes) return meshes.error();
  Movers movers;
  movers.meshes_ = std::move(*meshes);
  for (const auto& chunks : chunks_by_node(movers.meshes_))
    movers.names_.push_back(movers.meshes_.chunks[chunks.front()].node);
  return movers;
}

Result<std::size_t> Movers::mesh(std::string_view name) const {
  const auto found = std::ranges::find(names_, name);
  if (found == names_.end()) return Error{meshes_.file.string(), "has no node \"" + std::string(name) + "\""};
  return static_cast<std::size_t>(found - names_.begin());
}

}  // namespace phare
