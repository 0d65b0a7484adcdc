// A Vulkan layer whose device or window fails when it is told to: what drivers do once in a month, when a hard case or
// a test wants it. Enabled by VK_INSTANCE_LAYERS=VK_LAYER_PHARE_gpu_faults, found by VK_ADD_LAYER_PATH; it lies above
// the validation layer, which sees what the program makes of the failure. PHARE_GPU_FAULT says which, N counted from 1:
//   lost-device:N         the Nth submission, and all that is asked of that device afterwards: VK_ERROR_DEVICE_LOST
//   lost-surface:N        the Nth acquired image, and all of that surface until it is destroyed: VK_ERROR_SURFACE_LOST
//   lost-surface-shown:N  the same from the Nth presented image on
//   out-of-date-shown:N   the Nth presented image: VK_ERROR_OUT_OF_DATE
//   minimised:N:MS        from the Nth acquired image on the window has no size, for so many milliseconds
// PHARE_GPU_FAULT_TOLD is a file that is made when it happens; a process that finds it there fails no more. Beside it
// FILE.shown is made when the window has shown PHARE_GPU_FAULT_SHOWN pictures again, presented without a complaint.
#include <fcntl.h>
#include <unistd.h>
#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

using Clock = std::chrono::steady_clock;

struct Fault {
  std::string kind;
  long at = 0, ms = 0;
};

Fault read_fault() {
  const char* text = std::getenv("PHARE_GPU_FAULT");
  Fault fault;
  if (text == nullptr) return fault;
  fault.kind = text;
  const std::size_t first = fault.kind.find(':');
  if (first == std::string::npos) return {};
  char* end = nullptr;
  fault.at = std::strtol(text + first + 1, &end, 10);
  if (*end == ':') fault.ms = std::strtol(end + 1, nullptr, 10);
  fault.kind.resize(first);
  return fault;
}

/// One device and one window of a process: all that is tested.
struct State {
  Fault fault = read_fault();
  PFN_vkGetInstanceProcAddr next_instance = nullptr;
  PFN_vkGetDeviceProcAddr next_device = nullptr;
  VkInstance instance = VK_NULL_HANDLE;
  // Asked for while the instance is made: later, with no layer below, the loader answers with what leads here again.
  PFN_vkDestroySurfaceKHR destroy_surface = nullptr;
  PFN_vkGetPhysicalDeviceSurfaceCapabilitiesKHR surface_capabilities = nullptr;
  VkDevice device = VK_NULL_HANDLE;
  long submitted = 0, acquired = 0, presented = 0, shown_again = 0;
  bool happened = false, device_lost = false, surface_lost = false;
  Clock::time_point small_until{};
  bool was_small = false;
};
State state;

template <class Function>
Function below(const char* name) {
  return reinterpret_cast<Function>(state.device != VK_NULL_HANDLE ? state.next_device(state.device, name) : nullptr);
}

/// False: it is there already.
bool make_file(const std::string& path) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (file < 0) return false;
  close(file);
  return true;
}

/// Whether it is time for this fault, the first time that it is.
bool now(const char* kind, long count) {
  if (state.fault.kind != kind || count != state.fault.at) return false;
  const char* told = std::getenv("PHARE_GPU_FAULT_TOLD");
  state.happened = told == nullptr || make_file(told);
  return state.happened;
}

void count_shown_again() {
  const char *told = std::getenv("PHARE_GPU_FAULT_TOLD"), *count = std::getenv("PHARE_GPU_FAULT_SHOWN");
  if (told == nullptr || count == nullptr || !state.happened) return;
  if (++state.shown_again == std::strtol(count, nullptr, 10)) make_file(std::string(told) + ".shown");
}

bool is_small() {
  return Clock::now() < state.small_until;
}

VKAPI_ATTR VkResult VKAPI_CALL queue_submit(VkQueue queue, std::uint32_t count, const VkSubmitInfo* infos,
                                            VkFence fence) {
  if (now("lost-device", ++state.submitted)) state.device_lost = true;
  if (state.device_lost) return VK_ERROR_DEVICE_LOST;
  return below<PFN_vkQueueSubmit>("vkQueueSubmit")(queue, count, infos, fence);
}

VKAPI_ATTR VkResult VKAPI_CALL queue_submit_2(VkQueue queue, std::uint32_t count, const VkSubmitInfo2* infos,
                                              VkFence fence) {
  if (now("lost-device", ++state.submitted)) state.device_lost = true;
  if (state.device_lost) return VK_ERROR_DEVICE_LOST;
  return below<PFN_vkQueueSubmit2>("vkQueueSubmit2")(queue, count, infos, fence);
}

VKAPI_ATTR VkResult VKAPI_CALL wait_for_fences(VkDevice device, std::uint32_t count, const VkFence* fences,
                                               VkBool32 all, std::uint64_t timeout_ns) {
  if (state.device_lost) return VK_ERROR_DEVICE_LOST;
  return below<PFN_vkWaitForFences>("vkWaitForFences")(device, count, fences, all, timeout_ns);
}

VKAPI_ATTR VkResult VKAPI_CALL device_wait_idle(VkDevice device) {
  if (state.device_lost) return VK_ERROR_DEVICE_LOST;
  return below<PFN_vkDeviceWaitIdle>("vkDeviceWaitIdle")(device);
}

VKAPI_ATTR VkResult VKAPI_CALL acquire_next_image(VkDevice device, VkSwapchainKHR swapchain, std::uint64_t timeout_ns,
                                                  VkSemaphore semaphore, VkFence fence, std::uint32_t* image) {
  if (state.device_lost) return VK_ERROR_DEVICE_LOST;
  ++state.acquired;
  if (now("lost-surface", state.acquired)) state.surface_lost = true;
  if (now("minimised", state.acquired))
    state.small_until = Clock::now() + std::chrono::milliseconds(state.fault.ms), state.was_small = true;
  if (state.surface_lost) return VK_ERROR_SURFACE_LOST_KHR;
  if (is_small()) return VK_ERROR_OUT_OF_DATE_KHR;
  return below<PFN_vkAcquireNextImageKHR>("vkAcquireNextImageKHR")(device, swapchain, timeout_ns, semaphore, fence,
                                                                   image);
}

/// The image is handed back, as a driver does that reports so.
VKAPI_ATTR VkResult VKAPI_CALL queue_present(VkQueue queue, const VkPresentInfoKHR* info) {
  if (state.device_lost) return VK_ERROR_DEVICE_LOST;
  const VkResult shown = below<PFN_vkQueuePresentKHR>("vkQueuePresentKHR")(queue, info);
  ++state.presented;
  if (now("lost-surface-shown", state.presented)) {
    state.surface_lost = true;
    return VK_ERROR_SURFACE_LOST_KHR;
  }
  if (now("out-of-date-shown", state.presented)) return VK_ERROR_OUT_OF_DATE_KHR;
  if (shown == VK_SUCCESS || shown == VK_SUBOPTIMAL_KHR) count_shown_again();
  return shown;
}

VKAPI_ATTR VkResult VKAPI_CALL create_swapchain(VkDevice device, const VkSwapchainCreateInfoKHR* info,
                                                const VkAllocationCallbacks* allocator, VkSwapchainKHR* swapchain) {
  if (state.surface_lost) return VK_ERROR_SURFACE_LOST_KHR;
  return below<PFN_vkCreateSwapchainKHR>("vkCreateSwapchainKHR")(device, info, allocator, swapchain);
}

VKAPI_ATTR void VKAPI_CALL destroy_surface(VkInstance instance, VkSurfaceKHR surface,
                                           const VkAllocationCallbacks* allocator) {
  state.destroy_surface(instance, surface, allocator);
  state.surface_lost = false;
}

VKAPI_ATTR VkResult VKAPI_CALL surface_capabilities(VkPhysicalDevice device, VkSurfaceKHR surface,
                                                    VkSurfaceCapabilitiesKHR* capabilities) {
  if (state.surface_lost) return VK_ERROR_SURFACE_LOST_KHR;
  const VkResult result = state.surface_capabilities(device, surface, capabilities);
  if (is_small()) capabilities->currentExtent = {0, 0};
  return result;
}

/// The link that the loader left for this layer; what is below takes the next.
template <class Link, class Info>
Link* link_of(const Info* info, VkStructureType type) {
  auto* link = static_cast<Link*>(const_cast<void*>(info->pNext));
  while (link != nullptr && !(link->sType == type && link->function == VK_LAYER_LINK_INFO))
    link = static_cast<Link*>(const_cast<void*>(link->pNext));
  return link;
}

VKAPI_ATTR VkResult VKAPI_CALL create_instance(const VkInstanceCreateInfo* info, const VkAllocationCallbacks* allocator,
                                               VkInstance* instance) {
  auto* link = link_of<VkLayerInstanceCreateInfo>(info, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
  if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
  state.next_instance = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  const auto create = reinterpret_cast<PFN_vkCreateInstance>(state.next_instance(VK_NULL_HANDLE, "vkCreateInstance"));
  const VkResult result = create(info, allocator, instance);
  if (result != VK_SUCCESS) return result;
  state.instance = *instance;
  const auto ask = [&]<class Function>(const char* name, Function& function) {
    function = reinterpret_cast<Function>(state.next_instance(*instance, name));
  };
  ask("vkDestroySurfaceKHR", state.destroy_surface);
  ask("vkGetPhysicalDeviceSurfaceCapabilitiesKHR", state.surface_capabilities);
  return result;
}

VKAPI_ATTR VkResult VKAPI_CALL create_device(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                             const VkAllocationCallbacks* allocator, VkDevice* device) {
  auto* link = link_of<VkLayerDeviceCreateInfo>(info, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
  if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
  const PFN_vkGetInstanceProcAddr next = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  state.next_device = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  const auto create = reinterpret_cast<PFN_vkCreateDevice>(next(state.instance, "vkCreateDevice"));
  const VkResult result = create(physical, info, allocator, device);
  if (result == VK_SUCCESS) state.device = *device;
  return result;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instance_function(VkInstance instance, const char* name);

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL device_function(VkDevice device, const char* name);

PFN_vkVoidFunction ours(const char* name) {
  struct Named {
    const char* name;
    PFN_vkVoidFunction function;
  };
  const auto cast = [](auto function) { return reinterpret_cast<PFN_vkVoidFunction>(function); };
  static const Named all[] = {{"vkQueueSubmit", cast(queue_submit)},
                              {"vkQueueSubmit2", cast(queue_submit_2)},
                              {"vkWaitForFences", cast(wait_for_fences)},
                              {"vkDeviceWaitIdle", cast(device_wait_idle)},
                              {"vkAcquireNextImageKHR", cast(acquire_next_image)},
                              {"vkQueuePresentKHR", cast(queue_present)},
                              {"vkCreateSwapchainKHR", cast(create_swapchain)},
                              {"vkDestroySurfaceKHR", cast(destroy_surface)},
                              {"vkGetPhysicalDeviceSurfaceCapabilitiesKHR", cast(surface_capabilities)},
                              {"vkCreateInstance", cast(create_instance)},
                              {"vkCreateDevice", cast(create_device)},
                              {"vkGetInstanceProcAddr", cast(instance_function)},
                              {"vkGetDeviceProcAddr", cast(device_function)}};
  for (const Named& one : all)
    if (std::strcmp(one.name, name) == 0) return one.function;
  return nullptr;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instance_function(VkInstance instance, const char* name) {
  if (const PFN_vkVoidFunction function = ours(name)) return function;
  return state.next_instance != nullptr ? state.next_instance(instance, name) : nullptr;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL device_function(VkDevice device, const char* name) {
  if (const PFN_vkVoidFunction function = ours(name)) return function;
  return state.next_device != nullptr ? state.next_device(device, name) : nullptr;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) VkResult vkNegotiateLoaderLayerInterfaceVersion(
    VkNegotiateLayerInterface* negotiated) {
  negotiated->loaderLayerInterfaceVersion = 2;
  negotiated->pfnGetInstanceProcAddr = instance_function;
  negotiated->pfnGetDeviceProcAddr = device_function;
  negotiated->pfnGetPhysicalDeviceProcAddr = nullptr;
  return VK_SUCCESS;
}
