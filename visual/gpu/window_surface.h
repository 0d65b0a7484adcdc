// The swapchain of a window: the finished picture is copied into it by commands behind its own, and shown once the
// device has done both.
#pragma once

#include <chrono>
#include <optional>
#include <vector>

#include "visual/gpu/frame_graph.h"

struct GLFWwindow;

namespace phare::gpu {

class WindowSurface {
 public:
  /// `frames_in_flight`: so many pictures may be taken before the first of them is shown.
  WindowSurface(Device& device, GLFWwindow* window, std::size_t frames_in_flight);

  vk::Format format() const { return format_; }
  vk::Extent2D extent() const { return extent_; }
  /// Makes the swapchain anew after the window's size changed; and the surface, if that was lost. A window without a
  /// size (minimised) keeps the extent it had, for pictures that are still asked for, and is shown nothing. Throws when
  /// the surface is lost over and over.
  void rebuild();
  /// Copies `picture` (same size and format), that of the frame recorded last, for the window. False: the swapchain does
  /// not fit the window any more, rebuild and draw again. A minimised window takes no time.
  bool take(Image& picture);
  /// Shows what was taken in the frame of this number (Device::frame), if it was, and waits for its copy. False: as of
  /// take().
  bool show(std::size_t frame);

 private:
  using Clock = std::chrono::steady_clock;

  void make_surface();
  void make_swapchain();
  void mind_the_loss();
  bool minimised() const;
  vk::Extent2D size_of_window() const;
  bool back_again();
  bool copy(Image& picture);
  template <typename Do>
  bool minding_loss(Do&& act);

  /// The copy of one frame's picture.
  struct Taken {
    vk::raii::Semaphore acquired{nullptr};
    vk::raii::CommandBuffers commands{nullptr};
    vk::raii::Fence fence{nullptr};
    std::optional<std::uint32_t> image{};  ///< of the swapchain; nothing: none is to be shown
    bool fits = true;
  };

  Device& device_;
  GLFWwindow* window_;
  std::size_t frames_in_flight_;
  vk::raii::SurfaceKHR surface_{nullptr};
  vk::raii::SwapchainKHR swapchain_{nullptr};
  /// Of each of its images: that the copy is done. A fence of the copy says nothing of the showing that waits for it,
  /// so it may be signalled again only once its image is acquired again.
  std::vector<vk::raii::Semaphore> copied_{};
  vk::Format format_ = vk::Format::eB8G8R8A8Unorm;
  vk::Extent2D extent_{1, 1};
  bool hidden_ = false;        ///< minimised: it has no size
  Clock::time_point asked_{};  ///< when its size was asked for
  bool lost_ = false;          ///< the surface is to be made anew
  int losses_ = 0;             ///< since a picture was shown
  PerFrame<Taken> taken_{device_};
};

}  // namespace phare::gpu
