#include "visual/gpu/window_surface.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <stdexcept>

extern "C" VkResult glfwCreateWindowSurface(VkInstance, GLFWwindow*, const VkAllocationCallbacks*, VkSurfaceKHR*);

namespace phare::gpu {

WindowSurface::WindowSurface(Device& device, GLFWwindow* window)
    : device_(device),
      window_(window),
      acquired_(device.device, vk::SemaphoreCreateInfo{}),
      copied_(device.device, vk::SemaphoreCreateInfo{}) {
  VkSurfaceKHR surface = VK_NULL_HANDLE;
  if (glfwCreateWindowSurface(static_cast<VkInstance>(*device.instance), window, nullptr, &surface) != VK_SUCCESS)
    throw std::runtime_error("the window has no Vulkan surface");
  surface_ = vk::raii::SurfaceKHR(device.instance, surface);
  if (!device.physical.getSurfaceSupportKHR(device.queue_family, *surface_))
    throw std::runtime_error("the Vulkan device cannot present to this window");
  const std::vector<vk::SurfaceFormatKHR> formats = device.physical.getSurfaceFormatsKHR(*surface_);
  // The shaders write the sRGB signal themselves, so the format must not encode.
  const auto srgb = std::find_if(formats.begin(), formats.end(), [](const vk::SurfaceFormatKHR& f) {
    return f.colorSpace == vk::ColorSpaceKHR::eSrgbNonlinear &&
           (f.format == vk::Format::eB8G8R8A8Unorm || f.format == vk::Format::eR8G8B8A8Unorm);
  });
  if (srgb == formats.end()) throw std::runtime_error("the window has no 8-bit sRGB format");
  format_ = srgb->format;
  rebuild();
}

void WindowSurface::rebuild() {
  device_.device.waitIdle();
  const vk::SurfaceCapabilitiesKHR capabilities = device_.physical.getSurfaceCapabilitiesKHR(*surface_);
  extent_ = capabilities.currentExtent;
  if (extent_.width == UINT32_MAX) {
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    extent_ =
        vk::Extent2D{static_cast<std::uint32_t>(std::max(width, 1)), static_cast<std::uint32_t>(std::max(height, 1))};
  }
  if (extent_.width == 0 || extent_.height == 0) return;  // minimized
  const std::uint32_t most = capabilities.maxImageCount == 0 ? 3 : capabilities.maxImageCount;
  swapchain_ = vk::raii::SwapchainKHR(
      device_.device, vk::SwapchainCreateInfoKHR{.surface = *surface_,
                                                 .minImageCount = std::clamp(capabilities.minImageCount, 2u, most),
                                                 .imageFormat = format_,
                                                 .imageColorSpace = vk::ColorSpaceKHR::eSrgbNonlinear,
                                                 .imageExtent = extent_,
                                                 .imageArrayLayers = 1,
                                                 .imageUsage = vk::ImageUsageFlagBits::eTransferDst,
                                                 .preTransform = capabilities.currentTransform,
                                                 .compositeAlpha = vk::CompositeAlphaFlagBitsKHR::eOpaque,
                                                 .presentMode = vk::PresentModeKHR::eFifo,
                                                 .clipped = VK_TRUE,
                                                 .oldSwapchain = *swapchain_});
}

bool WindowSurface::present(Image& picture) {
  if (!*swapchain_) return true;
  if (picture.extent != extent_) return false;
  try {
    const std::vector<vk::Image> images =
        swapchain_.getImages();  // asked for before acquiring: the validation layer counts on it
    // With the smallest number of images the window may hold on to all: then this picture is not shown, rather than
    // waited for without end (VUID-vkAcquireNextImageKHR-surface-07783).
    constexpr std::uint64_t kPatience_ns = 100'000'000;
    const auto [acquire_result, index] = swapchain_.acquireNextImage(kPatience_ns, *acquired_);
    if (acquire_result == vk::Result::eTimeout || acquire_result == vk::Result::eNotReady) return true;
    const vk::Image target = images[index];
    vk::raii::CommandBuffers buffers(
        device_.device, vk::CommandBufferAllocateInfo{.commandPool = *device_.command_pool, .commandBufferCount = 1});
    const vk::CommandBuffer commands = *buffers.front();
    commands.begin(vk::CommandBufferBeginInfo{.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    auto turn = [&](vk::Image image, vk::ImageLayout from, vk::ImageLayout to, vk::PipelineStageFlags2 after,
                    vk::AccessFlags2 wrote, vk::PipelineStageFlags2 before, vk::AccessFlags2 use) {
      const vk::ImageMemoryBarrier2 barrier{.srcStageMask = after,
                                            .srcAccessMask = wrote,
                                            .dstStageMask = before,
                                            .dstAccessMask = use,
                                            .oldLayout = from,
                                            .newLayout = to,
                                            .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                            .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                            .image = image,
                                            .subresourceRange = {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1}};
      commands.pipelineBarrier2(vk::DependencyInfo{.imageMemoryBarrierCount = 1, .pImageMemoryBarriers = &barrier});
    };
    using Stage = vk::PipelineStageFlagBits2;
    using Access = vk::AccessFlagBits2;
    turn(*picture.image, picture.layout, vk::ImageLayout::eTransferSrcOptimal, picture.stage, picture.access,
         Stage::eCopy, Access::eTransferRead);
    turn(target, vk::ImageLayout::eUndefined, vk::ImageLayout::eTransferDstOptimal, Stage::eCopy, Access::eNone,
         Stage::eCopy, Access::eTransferWrite);
    commands.copyImage(*picture.image, vk::ImageLayout::eTransferSrcOptimal, target,
                       vk::ImageLayout::eTransferDstOptimal,
                       vk::ImageCopy{.srcSubresource = {vk::ImageAspectFlagBits::eColor, 0, 0, 1},
                                     .dstSubresource = {vk::ImageAspectFlagBits::eColor, 0, 0, 1},
                                     .extent = {extent_.width, extent_.height, 1}});
    turn(target, vk::ImageLayout::eTransferDstOptimal, vk::ImageLayout::ePresentSrcKHR, Stage::eCopy,
         Access::eTransferWrite, Stage::eNone, Access::eNone);
    commands.end();
    picture.layout = vk::ImageLayout::eTransferSrcOptimal;
    picture.stage = Stage::eCopy;
    picture.access = Access::eTransferRead;

    const vk::SemaphoreSubmitInfo wait{.semaphore = *acquired_, .stageMask = Stage::eCopy};
    const vk::SemaphoreSubmitInfo signal{.semaphore = *copied_, .stageMask = Stage::eAllCommands};
    const vk::CommandBufferSubmitInfo buffer{.commandBuffer = commands};
    const vk::raii::Fence fence(device_.device, vk::FenceCreateInfo{});
    device_.queue.submit2(vk::SubmitInfo2{.waitSemaphoreInfoCount = 1,
                                          .pWaitSemaphoreInfos = &wait,
                                          .commandBufferInfoCount = 1,
                                          .pCommandBufferInfos = &buffer,
                                          .signalSemaphoreInfoCount = 1,
                                          .pSignalSemaphoreInfos = &signal},
                          *fence);
    const vk::SwapchainKHR swapchain = *swapchain_;
    const vk::Semaphore done = *copied_;
    const vk::Result presented = device_.queue.presentKHR(vk::PresentInfoKHR{.waitSemaphoreCount = 1,
                                                                             .pWaitSemaphores = &done,
                                                                             .swapchainCount = 1,
                                                                             .pSwapchains = &swapchain,
                                                                             .pImageIndices = &index});
    if (device_.device.waitForFences(*fence, VK_TRUE, UINT64_MAX) != vk::Result::eSuccess)
      throw std::runtime_error("waiting for the GPU failed");
    return acquire_result == vk::Result::eSuccess && presented == vk::Result::eSuccess;
  } catch (const vk::OutOfDateKHRError&) {
    return false;
  }
}

}  // namespace phare::gpu
