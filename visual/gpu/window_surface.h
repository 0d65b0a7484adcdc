// The swapchain of a window: the finished picture is copied into it.
#pragma once

#include <chrono>

#include "visual/gpu/frame_graph.h"

struct GLFWwindow;

namespace phare::gpu {

class WindowSurface {
 public:
  WindowSurface(Device& device, GLFWwindow* window);

  vk::Format format() const { return format_; }
  vk::Extent2D extent() const { return extent_; }
  /// Makes the swapchain anew after the window's size changed; and the surface, if that was lost. A window without a
  /// size (minimised) keeps the extent it had, for pictures that are still asked for, and is shown nothing. Throws when
  /// the surface is lost over and over.
  void rebuild();
  /// Copies `picture` (same size and format) to the window. False: the swapchain does not fit the window any more,
  /// rebuild and draw again. A minimised window takes no time.
  bool present(Image& picture);

 private:
  using Clock = std::chrono::steady_clock;

  void make_surface();
  void make_swapchain();
  void mind_the_loss();
  bool minimised() const;
  vk::Extent2D size_of_window() const;
  bool back_again();
  bool show(Image& picture);

  Device& device_;
  GLFWwindow* window_;
  vk::raii::SurfaceKHR surface_{nullptr};
  vk::raii::SwapchainKHR swapchain_{nullptr};
  vk::Format format_ = vk::Format::eB8G8R8A8Unorm;
  vk::Extent2D extent_{1, 1};
  bool hidden_ = false;        ///< minimised: it has no size
  Clock::time_point asked_{};  ///< when its size was asked for
  bool lost_ = false;          ///< the surface is to be made anew
  int losses_ = 0;             ///< since a picture was shown
  vk::raii::Semaphore acquired_{nullptr}, copied_{nullptr};
};

}  // namespace phare::gpu
