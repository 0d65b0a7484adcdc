// What `phare --version` says: version, commit, and the device that draws.
#include <string>

#include "config/base/commit.h"
#include "tools/commands.h"
#ifdef PHARE_WITH_GRAPHICS
#include "visual/vulkan_devices.h"
#endif

namespace phare {

std::string version_text() {
  std::string text = std::string("phare ") + PHARE_VERSION + ", commit " + build_commit() + "\nVulkan device: ";
#ifdef PHARE_WITH_GRAPHICS
  const auto devices = list_vulkan_devices();
  if (!devices) return text + "none (" + devices.error().reason + "); see phare doctor";
  if (devices->empty()) return text + "none; see phare doctor";
  for (std::size_t i = 0; i < devices->size(); ++i) text += (i == 0 ? "" : "; ") + (*devices)[i];
  return text;
#else
  return text + "not asked, built without graphics";
#endif
}

}  // namespace phare
