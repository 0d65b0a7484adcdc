#include "visual/vulkan_devices.h"

#include "visual/gpu/device.h"

namespace phare {

Result<VulkanDevice> vulkan_device(const std::string& name_part) {
  try {
    const vk::raii::Context context;
    const vk::ApplicationInfo application{.pApplicationName = "phare", .apiVersion = VK_API_VERSION_1_3};
    const vk::raii::Instance instance(context, vk::InstanceCreateInfo{.pApplicationInfo = &application});
    const vk::PhysicalDeviceProperties properties = gpu::pick_device(instance, name_part).getProperties();
    return VulkanDevice{properties.deviceName.data(), properties.deviceType == vk::PhysicalDeviceType::eCpu};
  } catch (const std::exception& error) {
    return Error{"vulkan", error.what()};
  }
}

Result<std::vector<std::string>> list_vulkan_devices() {
  try {
    const vk::raii::Context context;
    const vk::ApplicationInfo application{.pApplicationName = "phare", .apiVersion = VK_API_VERSION_1_3};
    const vk::raii::Instance instance(context, vk::InstanceCreateInfo{.pApplicationInfo = &application});
    std::vector<std::string> names;
    for (const vk::raii::PhysicalDevice& device : vk::raii::PhysicalDevices(instance)) {
      const auto chain = device.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>();
      const auto& properties = chain.get<vk::PhysicalDeviceProperties2>().properties;
      names.push_back(std::string(properties.deviceName.data()) + ", " +
                      std::string(chain.get<vk::PhysicalDeviceDriverProperties>().driverInfo.data()) + ", Vulkan " +
                      std::to_string(VK_API_VERSION_MAJOR(properties.apiVersion)) + "." +
                      std::to_string(VK_API_VERSION_MINOR(properties.apiVersion)));
    }
    return names;
  } catch (const std::exception& error) {
    return Error{"vulkan", error.what()};
  }
}

}  // namespace phare
