// The swapchain of a window: the finished picture is copied into it.
#pragma once

#include "visual/gpu/frame_graph.h"

struct GLFWwindow;

namespace phare::gpu {

class WindowSurface {
 public:
  WindowSurface(Device& device, GLFWwindow* window);

  vk::Format format() const { return format_; }
  vk::Extent2D extent() const { return extent_; }
  /// Makes the swapchain anew after the window's size changed.
  void rebuild();
  /// Copies `picture` (same size and format) to the window. False: the swapchain was out of date, rebuild and draw
  /// again.
  bool present(Image& picture);

 private:
  Device& device_;
  GLFWwindow* window_;
  vk::raii::SurfaceKHR surface_{nullptr};
  vk::raii::SwapchainKHR swapchain_{nullptr};
  vk::Format format_ = vk::Format::eB8G8R8A8Unorm;
  vk::Extent2D extent_{};
  vk::raii::Semaphore acquired_{nullptr}, copied_{nullptr};
};

}  // namespace phare::gpu
