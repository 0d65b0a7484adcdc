#include "vehicle_dynamics/level.h"

#include "config/rig.h"

namespace phare {

const char* name(Level level) {
  return kDynamicsLevelNames[static_cast<std::size_t>(level)].data();
}

Result<Level> parse_level(const std::string& text, const std::string& place) {
  std::string all;
  for (std::size_t i = 0; i < kDynamicsLevelNames.size(); ++i) {
    if (text == kDynamicsLevelNames[i]) return static_cast<Level>(i);
    all += (i == 0 ? "" : ", ") + std::string(kDynamicsLevelNames[i]);
  }
  return Error{place, "level \"" + text + "\" is unknown; there are " + all};
}

}  // namespace phare
