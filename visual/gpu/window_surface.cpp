#include "visual/gpu/window_surface.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

extern "C" VkResult glfwCreateWindowSurface(VkInstance, GLFWwindow*, const VkAllocationCallbacks*, VkSurfaceKHR*);

namespace phare::gpu {

WindowSurface::WindowSurface(Device& device, GLFWwindow* window, std::size_t frames_in_flight)
    : device_(device), window_(window), frames_in_flight_(frames_in_flight) {
  for (Taken& taken : taken_.all()) {
    taken.acquired = vk::raii::Semaphore(device.device, vk::SemaphoreCreateInfo{});
    taken.commands = vk::raii::CommandBuffers(
        device.device, vk::CommandBufferAllocateInfo{.commandPool = *device.command_pool, .commandBufferCount = 1});
    taken.fence = vk::raii::Fence(device.device, vk::FenceCreateInfo{});
  }
  make_surface();
  rebuild();
}

void WindowSurface::make_surface() {
  swapchain_.clear();  // it goes before its surface
  surface_.clear();
  VkSurfaceKHR surface = VK_NULL_HANDLE;
  if (glfwCreateWindowSurface(static_cast<VkInstance>(*device_.instance), window_, nullptr, &surface) != VK_SUCCESS)
    throw std::runtime_error("the window has no Vulkan surface");
  surface_ = vk::raii::SurfaceKHR(device_.instance, surface);
  if (!device_.physical.getSurfaceSupportKHR(device_.queue_family, *surface_))
    throw std::runtime_error("the Vulkan device cannot present to this window");
  const std::vector<vk::SurfaceFormatKHR> formats = device_.physical.getSurfaceFormatsKHR(*surface_);
  // The shaders write the sRGB signal themselves, so the format must not encode.
  const auto srgb = std::find_if(formats.begin(), formats.end(), [](const vk::SurfaceFormatKHR& f) {
    return f.colorSpace == vk::ColorSpaceKHR::eSrgbNonlinear &&
           (f.format == vk::Format::eB8G8R8A8Unorm || f.format == vk::Format::eR8G8B8A8Unorm);
  });
  if (srgb == formats.end()) throw std::runtime_error("the window has no 8-bit sRGB format");
  format_ = srgb->format;
}

/// On X11 such a window keeps its size, and may be shown no picture for ever.
bool WindowSurface::minimised() const {
  return glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == GLFW_TRUE;
}

vk::Extent2D WindowSurface::size_of_window() const {
  if (minimised()) return {0, 0};
  const vk::Extent2D there = device_.physical.getSurfaceCapabilitiesKHR(*surface_).currentExtent;
  if (there.width != UINT32_MAX) return there;
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  return {static_cast<std::uint32_t>(std::max(width, 1)), static_cast<std::uint32_t>(std::max(height, 1))};
}

void WindowSurface::rebuild() {
  device_.device.waitIdle();
  for (;;) {
    try {
      if (lost_) make_surface();
      return make_swapchain();
    } catch (const vk::SurfaceLostKHRError&) {
      mind_the_loss();
    }
  }
}

void WindowSurface::mind_the_loss() {
  constexpr int kMostLosses = 3;
  if (++losses_ > kMostLosses)
    throw std::runtime_error("the window's surface was lost " + std::to_string(losses_) + " times without a picture");
  spdlog::warn("the window's surface was lost; making it anew");
  lost_ = true;
}

void WindowSurface::make_swapchain() {
  const vk::Extent2D size = size_of_window();
  lost_ = false;
  const bool was_hidden = std::exchange(hidden_, size.width == 0 || size.height == 0);
  asked_ = Clock::now();
  if (hidden_ != was_hidden) spdlog::info(hidden_ ? "the window is minimised" : "the window is back");
  if (hidden_) return;
  extent_ = size;
  const vk::SurfaceCapabilitiesKHR capabilities = device_.physical.getSurfaceCapabilitiesKHR(*surface_);
  // One is held from when its picture is taken until it is shown.
  const auto fewest = std::max(capabilities.minImageCount + static_cast<std::uint32_t>(frames_in_flight_) - 1, 2u);
  const std::uint32_t most = capabilities.maxImageCount == 0 ? fewest : capabilities.maxImageCount;
  swapchain_ = vk::raii::SwapchainKHR(
      device_.device, vk::SwapchainCreateInfoKHR{.surface = *surface_,
                                                 .minImageCount = std::min(fewest, most),
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
  copied_.clear();  // the device is idle, and what was shown is of the swapchain before
  for (std::size_t i = 0; i < swapchain_.getImages().size(); ++i)
    copied_.emplace_back(device_.device, vk::SemaphoreCreateInfo{});
}

bool WindowSurface::back_again() {
  constexpr auto kAskedEvery = std::chrono::milliseconds(100);
  if (Clock::now() - asked_ < kAskedEvery) return false;
  asked_ = Clock::now();
  const vk::Extent2D size = size_of_window();
  return size.width > 0 && size.height > 0;
}

template <typename Do>
bool WindowSurface::minding_loss(Do&& act) {
  try {
    return act();
  } catch (const vk::OutOfDateKHRError&) {
    return false;
  } catch (const vk::SurfaceLostKHRError&) {
    mind_the_loss();
    return false;
  }
}

bool WindowSurface::take(Image& picture) {
  return minding_loss([&] {
    if (hidden_) return !back_again();
    if (minimised()) return false;
    return !*swapchain_ || copy(picture);
  });
}

bool WindowSurface::copy(Image& picture) {
  if (picture.extent != extent_) return false;
  Taken& taken = *taken_;
  const std::vector<vk::Image> images =
      swapchain_.getImages();  // asked for before acquiring: the validation layer counts on it
  // With the smallest number of images the window may hold on to all: then this picture is not shown, rather than
  // waited for without end (VUID-vkAcquireNextImageKHR-surface-07783).
  constexpr std::uint64_t kPatience_ns = 100'000'000;
  const auto [acquire_result, index] = swapchain_.acquireNextImage(kPatience_ns, *taken.acquired);
  if (acquire_result == vk::Result::eTimeout || acquire_result == vk::Result::eNotReady) return true;
  const vk::Image target = images[index];
  const vk::CommandBuffer commands = *taken.commands.front();
  commands.reset();
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
  commands.copyImage(*picture.image, vk::ImageLayout::eTransferSrcOptimal, target, vk::ImageLayout::eTransferDstOptimal,
                     vk::ImageCopy{.srcSubresource = {vk::ImageAspectFlagBits::eColor, 0, 0, 1},
                                   .dstSubresource = {vk::ImageAspectFlagBits::eColor, 0, 0, 1},
                                   .extent = {extent_.width, extent_.height, 1}});
  turn(target, vk::ImageLayout::eTransferDstOptimal, vk::ImageLayout::ePresentSrcKHR, Stage::eCopy,
       Access::eTransferWrite, Stage::eNone, Access::eNone);
  commands.end();
  picture.layout = vk::ImageLayout::eTransferSrcOptimal;
  picture.stage = Stage::eCopy;
  picture.access = Access::eTransferRead;

  const vk::SemaphoreSubmitInfo wait{.semaphore = *taken.acquired, .stageMask = Stage::eCopy};
  const vk::SemaphoreSubmitInfo signal{.semaphore = *copied_[index], .stageMask = Stage::eAllCommands};
  const vk::CommandBufferSubmitInfo buffer{.commandBuffer = commands};
  device_.device.resetFences(*taken.fence);
  device_.queue.submit2(vk::SubmitInfo2{.waitSemaphoreInfoCount = 1,
                                        .pWaitSemaphoreInfos = &wait,
                                        .commandBufferInfoCount = 1,
                                        .pCommandBufferInfos = &buffer,
                                        .signalSemaphoreInfoCount = 1,
                                        .pSignalSemaphoreInfos = &signal},
                        *taken.fence);
  taken.image = index;
  taken.fits = acquire_result == vk::Result::eSuccess;
  return true;
}

bool WindowSurface::show(std::size_t frame) {
  Taken& taken = taken_.all()[frame];
  const std::optional<std::uint32_t> index = std::exchange(taken.image, std::nullopt);
  if (!index) return true;
  return minding_loss([&] {
    const vk::SwapchainKHR swapchain = *swapchain_;
    const vk::Semaphore done = *copied_[*index];
    // Whatever comes of showing it: what was submitted is waited for.
    std::exception_ptr not_shown;
    bool fits = taken.fits;
    try {
      fits = device_.queue.presentKHR(vk::PresentInfoKHR{.waitSemaphoreCount = 1,
                                                         .pWaitSemaphores = &done,
                                                         .swapchainCount = 1,
                                                         .pSwapchains = &swapchain,
                                                         .pImageIndices = &*index}) == vk::Result::eSuccess &&
             fits;
    } catch (const vk::SystemError&) {
      not_shown = std::current_exception();
    }
    if (device_.device.waitForFences(*taken.fence, VK_TRUE, UINT64_MAX) != vk::Result::eSuccess)
      throw std::runtime_error("waiting for the GPU failed");
    if (not_shown) std::rethrow_exception(not_shown);
    losses_ = 0;
    return fits;
  });
}

}  // namespace phare::gpu
