#include "visual/gpu/device.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>

#include "visual/gpu/failure.h"

namespace phare::gpu {

std::string reason_of(const std::exception& failure) {
  if (dynamic_cast<const vk::DeviceLostError*>(&failure) == nullptr) return failure.what();
  return "the graphics device was lost (" + std::string(failure.what()) +
         "): its driver was reset or it was taken away; a process begun anew asks for it again";
}

namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  static_cast<std::atomic<std::uint64_t>*>(user)->fetch_add(1);
  spdlog::error("vulkan validation: {}", data->pMessage);
  return VK_FALSE;
}

vk::raii::Instance make_instance(const vk::raii::Context& context, const DeviceOptions& options) {
  const vk::ApplicationInfo application{
      .pApplicationName = "phare", .pEngineName = "phare", .apiVersion = VK_API_VERSION_1_3};
  std::vector<const char*> layers;
  std::vector<const char*> extensions = options.instance_extensions;
  const std::array enabled = {vk::ValidationFeatureEnableEXT::eSynchronizationValidation};
  const vk::ValidationFeaturesEXT features{.enabledValidationFeatureCount = static_cast<std::uint32_t>(enabled.size()),
                                           .pEnabledValidationFeatures = enabled.data()};
  vk::InstanceCreateInfo info{.pApplicationInfo = &application};
  if (options.validation) {
    const auto there = context.enumerateInstanceLayerProperties();
    if (std::none_of(there.begin(), there.end(), [](const vk::LayerProperties& layer) {
          return std::string_view(layer.layerName.data()) == kValidationLayer;
        }))
      throw std::runtime_error(
          "Vulkan validation was asked for, but its layer is missing (apt-get install vulkan-validationlayers)");
    layers.push_back(kValidationLayer);
    extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    info.pNext = &features;
  }
  info.enabledLayerCount = static_cast<std::uint32_t>(layers.size());
  info.ppEnabledLayerNames = layers.data();
  info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  return vk::raii::Instance(context, info);
}

bool has_multi_draw(const vk::raii::PhysicalDevice& device) {
  return std::ranges::any_of(device.enumerateDeviceExtensionProperties(),
                             [](const vk::ExtensionProperties& extension) {
                               return std::string_view(extension.extensionName.data()) ==
                                      VK_EXT_MULTI_DRAW_EXTENSION_NAME;
                             }) &&
         device.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceMultiDrawFeaturesEXT>()
                 .get<vk::PhysicalDeviceMultiDrawFeaturesEXT>()
                 .multiDraw == VK_TRUE;
}

}  // namespace

vk::raii::PhysicalDevice pick_device(const vk::raii::Instance& instance, const std::string& wanted) {
  std::vector<vk::raii::PhysicalDevice> devices = vk::raii::PhysicalDevices(instance);
  if (devices.empty())
    throw std::runtime_error("no Vulkan device (apt-get install mesa-vulkan-drivers gives a software one)");
  auto rank = [&](const vk::raii::PhysicalDevice& device) {
    const vk::PhysicalDeviceProperties properties = device.getProperties();
    if (properties.apiVersion < VK_API_VERSION_1_3) return -1;
    if (!wanted.empty())
      return std::string_view(properties.deviceName.data()).find(wanted) != std::string_view::npos ? 1 : -1;
    switch (properties.deviceType) {
      case vk::PhysicalDeviceType::eDiscreteGpu:
        return 3;
      case vk::PhysicalDeviceType::eIntegratedGpu:
        return 2;
      case vk::PhysicalDeviceType::eVirtualGpu:
        return 1;
      default:
        return 0;
    }
  };
  auto best =
      std::max_element(devices.begin(), devices.end(), [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  if (rank(*best) < 0)
    throw std::runtime_error(wanted.empty() ? "no Vulkan 1.3 device"
                                            : "no Vulkan 1.3 device whose name contains \"" + wanted + "\"");
  return std::move(*best);
}

Device::Device(const DeviceOptions& options) {
  instance = make_instance(context, options);
  if (options.validation) {
    using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
    using Type = vk::DebugUtilsMessageTypeFlagBitsEXT;
    messenger = vk::raii::DebugUtilsMessengerEXT(
        instance, vk::DebugUtilsMessengerCreateInfoEXT{.messageSeverity = Severity::eWarning | Severity::eError,
                                                       .messageType = Type::eValidation | Type::ePerformance,
                                                       .pfnUserCallback = on_message,
                                                       .pUserData = validation_messages.get()});
  }
  physical = pick_device(instance, options.device_name);
  const auto chain = physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>();
  properties = chain.get<vk::PhysicalDeviceProperties2>().properties;
  const auto& driver_properties = chain.get<vk::PhysicalDeviceDriverProperties>();
  driver = std::string(driver_properties.driverName.data()) + " " + std::string(driver_properties.driverInfo.data());

  const std::vector<vk::QueueFamilyProperties> families = physical.getQueueFamilyProperties();
  const auto family = std::find_if(families.begin(), families.end(), [](const vk::QueueFamilyProperties& f) {
    return static_cast<bool>(f.queueFlags & vk::QueueFlagBits::eGraphics);
  });
  if (family == families.end()) throw std::runtime_error("the Vulkan device has no graphics queue");
  queue_family = static_cast<std::uint32_t>(family - families.begin());
  if (family->timestampValidBits > 0) stamp_bits = ~std::uint64_t{0} >> (64 - family->timestampValidBits);

  const float priority = 1.0f;
  const vk::DeviceQueueCreateInfo queue_info{
      .queueFamilyIndex = queue_family, .queueCount = 1, .pQueuePriorities = &priority};
  vk::PhysicalDeviceVulkan13Features features13{
      .synchronization2 = VK_TRUE, .dynamicRendering = VK_TRUE, .maintenance4 = VK_TRUE};
  const vk::PhysicalDeviceFeatures there = physical.getFeatures();
  float64 = options.float64 && there.shaderFloat64 == VK_TRUE;
  if (there.samplerAnisotropy == VK_TRUE) most_anisotropy = properties.limits.maxSamplerAnisotropy;
  primitive_id = there.geometryShader == VK_TRUE;
  const vk::PhysicalDeviceFeatures features{.geometryShader = primitive_id ? VK_TRUE : VK_FALSE,
                                            .samplerAnisotropy = there.samplerAnisotropy,
                                            .shaderFloat64 = float64 ? VK_TRUE : VK_FALSE};
  std::vector<const char*> extensions;
  vk::PhysicalDeviceMultiDrawFeaturesEXT of_multi_draw{.multiDraw = VK_TRUE};
  const bool draws_many = options.multi_draw && has_multi_draw(physical);
  if (draws_many) {
    extensions.push_back(VK_EXT_MULTI_DRAW_EXTENSION_NAME);
    features13.pNext = &of_multi_draw;
  }
  if (!options.instance_extensions.empty()) extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
  device = vk::raii::Device(physical,
                            vk::DeviceCreateInfo{.pNext = &features13,
                                                 .queueCreateInfoCount = 1,
                                                 .pQueueCreateInfos = &queue_info,
                                                 .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
                                                 .ppEnabledExtensionNames = extensions.data(),
                                                 .pEnabledFeatures = &features});
  processor_depths = options.processor_depths && properties.deviceType == vk::PhysicalDeviceType::eCpu;
  if (draws_many)
    multi_draw = {reinterpret_cast<PFN_vkCmdDrawMultiIndexedEXT>(device.getProcAddr("vkCmdDrawMultiIndexedEXT")),
                  physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceMultiDrawPropertiesEXT>()
                      .get<vk::PhysicalDeviceMultiDrawPropertiesEXT>()
                      .maxMultiDrawCount};
  queue = vk::raii::Queue(device, queue_family, 0);
  command_pool = vk::raii::CommandPool(
      device, vk::CommandPoolCreateInfo{.flags = vk::CommandPoolCreateFlagBits::eResetCommandBuffer,
                                        .queueFamilyIndex = queue_family});
}

Memory Device::allocate(const vk::MemoryRequirements& need, vk::MemoryPropertyFlags flags) {
  const vk::PhysicalDeviceMemoryProperties memory = physical.getMemoryProperties();
  for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
    if ((need.memoryTypeBits & (1u << i)) == 0 || (memory.memoryTypes[i].propertyFlags & flags) != flags) continue;
    return Memory(
        vk::raii::DeviceMemory(device, vk::MemoryAllocateInfo{.allocationSize = need.size, .memoryTypeIndex = i}),
        need.size, allocated_bytes);
  }
  throw std::runtime_error("no Vulkan memory type with " + vk::to_string(flags));
}

void Device::run_once(const std::function<void(vk::CommandBuffer)>& record) {
  vk::raii::CommandBuffers buffers(
      device, vk::CommandBufferAllocateInfo{.commandPool = *command_pool, .commandBufferCount = 1});
  const vk::CommandBuffer commands = *buffers.front();
  commands.begin(vk::CommandBufferBeginInfo{.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
  record(commands);
  commands.end();
  const vk::raii::Fence fence(device, vk::FenceCreateInfo{});
  queue.submit(vk::SubmitInfo{.commandBufferCount = 1, .pCommandBuffers = &commands}, *fence);
  if (device.waitForFences(*fence, VK_TRUE, UINT64_MAX) != vk::Result::eSuccess)
    throw std::runtime_error("waiting for the GPU failed");
}

void Device::wait_for_frames() {
  if (std::exchange(frames_on_way, false)) queue.waitIdle();
}

void Device::name(vk::ObjectType type, std::uint64_t handle, const std::string& text) const {
  if (!*messenger) return;
  device.setDebugUtilsObjectNameEXT(
      vk::DebugUtilsObjectNameInfoEXT{.objectType = type, .objectHandle = handle, .pObjectName = text.c_str()});
}

HostBuffer::HostBuffer(Device& device, vk::DeviceSize size, vk::BufferUsageFlags usage, const std::string& name,
                       bool read_back)
    : buffer(device.device, vk::BufferCreateInfo{.size = size, .usage = usage}), bytes(size) {
  using Flag = vk::MemoryPropertyFlagBits;
  const vk::MemoryPropertyFlags flags = Flag::eHostVisible | Flag::eHostCoherent;
  try {
    // What shaders read each pixel had better lie on the device; what the CPU reads, in its caches.
    memory =
        device.allocate(buffer.getMemoryRequirements(), flags | (read_back ? Flag::eHostCached : Flag::eDeviceLocal));
  } catch (const std::runtime_error&) {
    memory = device.allocate(buffer.getMemoryRequirements(), flags);
  }
  buffer.bindMemory(*memory, 0);
  data = memory->mapMemory(0, VK_WHOLE_SIZE);
  device.name(vk::ObjectType::eBuffer, reinterpret_cast<std::uint64_t>(static_cast<VkBuffer>(*buffer)), name);
}

DeviceBuffer::DeviceBuffer(Device& device, vk::DeviceSize bytes_, vk::BufferUsageFlags usage, const std::string& name)
    : buffer(device.device,
             vk::BufferCreateInfo{.size = bytes_, .usage = usage | vk::BufferUsageFlagBits::eTransferDst}),
      bytes(bytes_) {
  memory = device.allocate(buffer.getMemoryRequirements(), vk::MemoryPropertyFlagBits::eDeviceLocal);
  buffer.bindMemory(*memory, 0);
  device.name(vk::ObjectType::eBuffer, reinterpret_cast<std::uint64_t>(static_cast<VkBuffer>(*buffer)), name);
}

DeviceBuffer::DeviceBuffer(Device& device, std::span<const std::byte> content, vk::BufferUsageFlags usage,
                           const std::string& name)
    : DeviceBuffer(device, std::max<vk::DeviceSize>(content.size(), 16), usage, name) {
  if (content.empty()) return;
  constexpr std::size_t kPiece = std::size_t{64} << 20;  // a scene of ten million triangles has half a GiB
  const HostBuffer staging(device, std::min(content.size(), kPiece), vk::BufferUsageFlagBits::eTransferSrc,
                           name + " staging");
  for (std::size_t at = 0; at < content.size(); at += kPiece) {
    const std::span<const std::byte> piece = content.subspan(at, std::min(content.size() - at, kPiece));
    std::memcpy(staging.data, piece.data(), piece.size());
    device.run_once([&](vk::CommandBuffer commands) {
      commands.copyBuffer(*staging.buffer, *buffer, vk::BufferCopy{.dstOffset = at, .size = piece.size()});
    });
  }
}

Image::Image(Device& device, const ImageNeed& need, const std::string& name_)
    : image(device.device, vk::ImageCreateInfo{.imageType = vk::ImageType::e2D,
                                               .format = need.format,
                                               .extent = {need.extent.width, need.extent.height, 1},
                                               .mipLevels = need.mips,
                                               .arrayLayers = need.layers,
                                               .samples = need.samples,
                                               .usage = need.usage}),
      format(need.format),
      extent(need.extent),
      layers(need.layers),
      mips(need.mips),
      bytes(image.getMemoryRequirements().size),
      aspect(need.format == vk::Format::eD32Sfloat ? vk::ImageAspectFlagBits::eDepth : vk::ImageAspectFlagBits::eColor),
      samples(need.samples),
      name(name_) {
  device.name(vk::ObjectType::eImage, reinterpret_cast<std::uint64_t>(static_cast<VkImage>(*image)), name);
}

void Image::bind(Device& device, vk::DeviceMemory at) {
  image.bindMemory(at, 0);
  const auto view_of = [&](vk::ImageViewType type, const vk::ImageSubresourceRange& range) {
    return vk::raii::ImageView(
        device.device,
        vk::ImageViewCreateInfo{.image = *image, .viewType = type, .format = format, .subresourceRange = range});
  };
  view = view_of(layers > 1 ? vk::ImageViewType::e2DArray : vk::ImageViewType::e2D, {aspect, 0, mips, 0, layers});
  if (layers * mips == 1) return;
  for (std::uint32_t mip = 0; mip < mips; ++mip)
    for (std::uint32_t layer = 0; layer < layers; ++layer)
      parts.push_back(view_of(vk::ImageViewType::e2D, {aspect, mip, 1, layer, 1}));
}

Image::Image(Device& device, vk::Format format_, vk::Extent2D extent_, vk::ImageUsageFlags usage,
             const std::string& name_, vk::SampleCountFlagBits samples_, std::uint32_t mip_levels)
    : Image(device, {format_, extent_, usage, samples_, 1, mip_levels}, name_) {
  memory = device.allocate(image.getMemoryRequirements(), vk::MemoryPropertyFlagBits::eDeviceLocal);
  bind(device, *memory);
}

void record_fill(vk::CommandBuffer commands, Image& image, vk::Buffer from,
                 std::span<const vk::BufferImageCopy> copies) {
  using Stage = vk::PipelineStageFlagBits2;
  using Access = vk::AccessFlagBits2;
  const auto turn = [&](vk::ImageLayout layout, vk::PipelineStageFlags2 stage, vk::AccessFlags2 access) {
    const vk::ImageMemoryBarrier2 barrier{
        .srcStageMask = image.stage,
        .srcAccessMask = image.access,
        .dstStageMask = stage,
        .dstAccessMask = access,
        .oldLayout = image.layout,
        .newLayout = layout,
        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .image = *image.image,
        .subresourceRange = {image.aspect, 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS}};
    commands.pipelineBarrier2(vk::DependencyInfo{.imageMemoryBarrierCount = 1, .pImageMemoryBarriers = &barrier});
    image.layout = layout;
    image.stage = stage;
    image.access = access;
  };
  // What the copies leave out stays as it was, if something was.
  turn(vk::ImageLayout::eTransferDstOptimal, Stage::eCopy, Access::eTransferWrite);
  commands.copyBufferToImage(from, *image.image, vk::ImageLayout::eTransferDstOptimal,
                             {static_cast<std::uint32_t>(copies.size()), copies.data()});
  turn(vk::ImageLayout::eShaderReadOnlyOptimal, Stage::eVertexShader | Stage::eFragmentShader,
       Access::eShaderSampledRead);
}

vk::raii::ShaderModule make_shader(const Device& device, std::span<const std::uint32_t> spirv) {
  return vk::raii::ShaderModule(device.device,
                                vk::ShaderModuleCreateInfo{.codeSize = spirv.size_bytes(), .pCode = spirv.data()});
}

}  // namespace phare::gpu
