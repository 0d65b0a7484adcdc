// What is on its way to the device: frames that it has been given and has not done, shown in the window and timed when
// it has. kMostFramesInFlight at once, numbered by Device::frame.
#pragma once

#include <array>
#include <chrono>
#include <optional>
#include <utility>
#include <vector>

#include "visual/gpu/frame_graph.h"
#include "visual/gpu/window_surface.h"

namespace phare::gpu {

class Submissions {
 public:
  using Clock = std::chrono::steady_clock;

  /// Of the newest frame that is done, until they are taken.
  struct Times {
    double wall_ms = 0.0;  ///< from its call, or from when the frame before was done
    double gpu_ms = 0.0;
    bool kept = false;  ///< something of it was read back
    std::vector<FrameGraph::Timing> passes;
  };

  /// `surface`: the window's; null: none.
  Submissions(Device& device, FrameGraph& graph, WindowSurface* surface);

  /// Submits what `record` puts into the graph, as of Device::frame.
  template <typename Record>
  void submit(Record&& record) {
    const vk::CommandBuffer buffer = begin();
    graph_.begin(buffer);
    record();
    graph_.end();
    end(buffer);
  }
  /// The same, alone on the device.
  template <typename Record>
  void submit_and_wait(Record&& record) {
    finish();
    submit(std::forward<Record>(record));
    wait_for(submissions_[device_.frame]);
  }
  /// Of what was submitted last, a frame: when it was called for, and whether something of it is read back.
  void mark_frame(Clock::time_point begun, bool kept);
  /// Its picture, for the window.
  void take_picture(Image& display);

  /// Waits for the frame of this number, shows it and takes its times.
  void finish(std::size_t frame);
  void finish();  ///< the same of all
  /// Waits no longer than that. False: one is still on its way.
  bool finish_within(std::chrono::nanoseconds most);
  bool on_way(std::size_t frame) const { return submissions_[frame].on_way; }
  /// Than the one recorded last: if it is on its way, the older one.
  std::size_t other_frame() const { return (device_.frame + 1) % submissions_.size(); }

  /// What was kept last is there: its frame is done, or another has its number by now.
  bool has_kept() const { return !submissions_[kept_by_].on_way || !submissions_[kept_by_].kept; }
  void finish_kept();  ///< until it is

  std::optional<Times> take_times() { return std::exchange(times_, std::nullopt); }
  /// The window is another than the newest frame was drawn for. Told once.
  bool take_misfit() { return std::exchange(misfit_, false); }

 private:
  /// What goes to the device at once.
  struct Submission {
    vk::raii::CommandBuffers commands{nullptr};
    vk::raii::Fence fence{nullptr};
    bool on_way = false;
    Clock::time_point begun{};
    bool kept = false;
  };
  vk::CommandBuffer begin();
  void end(vk::CommandBuffer buffer);
  void wait_for(Submission& submission);

  Device& device_;
  FrameGraph& graph_;
  WindowSurface* surface_;
  std::array<Submission, kMostFramesInFlight> submissions_;  ///< by Device::frame
  std::size_t kept_by_ = 0;                                  ///< which of them has read something back last
  std::optional<Times> times_;
  Clock::time_point done_{};  ///< when the newest frame was
  bool misfit_ = false;
};

}  // namespace phare::gpu
