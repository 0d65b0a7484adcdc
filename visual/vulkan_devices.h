// Which Vulkan devices this machine has; none is opened.
#pragma once

#include <string>
#include <vector>

#include "config/base/result.h"

namespace phare {

/// A device as it would be taken by Renderer::create.
struct VulkanDevice {
  std::string name;
  bool software = false;  ///< it computes on the processor
};
/// `name_part`: as RendererOptions::device_name. Error: there is none.
Result<VulkanDevice> vulkan_device(const std::string& name_part);

/// Names of the Vulkan devices of this machine, or why there are none (for `phare doctor`).
Result<std::vector<std::string>> list_vulkan_devices();

}  // namespace phare
