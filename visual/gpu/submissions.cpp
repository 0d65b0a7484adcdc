#include "visual/gpu/submissions.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>

namespace phare::gpu {

Submissions::Submissions(Device& device, FrameGraph& graph, WindowSurface* surface)
    : device_(device), graph_(graph), surface_(surface) {
  for (Submission& submission : submissions_) {
    submission.commands = vk::raii::CommandBuffers(
        device.device, vk::CommandBufferAllocateInfo{.commandPool = *device.command_pool, .commandBufferCount = 1});
    submission.fence = vk::raii::Fence(device.device, vk::FenceCreateInfo{});
  }
}

void Submissions::wait_for(Submission& submission) {
  if (!std::exchange(submission.on_way, false)) return;
  if (device_.device.waitForFences(*submission.fence, VK_TRUE, UINT64_MAX) != vk::Result::eSuccess)
    throw std::runtime_error("waiting for the GPU failed");
  device_.frames_on_way = std::ranges::any_of(submissions_, &Submission::on_way);
}

vk::CommandBuffer Submissions::begin() {
  Submission& now = submissions_[device_.frame];
  wait_for(now);  // one that failed to be recorded has left another of this number
  const vk::CommandBuffer buffer = *now.commands.front();
  buffer.reset();
  buffer.begin(vk::CommandBufferBeginInfo{.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
  return buffer;
}

void Submissions::end(vk::CommandBuffer buffer) {
  Submission& now = submissions_[device_.frame];
  buffer.end();
  device_.device.resetFences(*now.fence);
  device_.queue.submit(vk::SubmitInfo{.commandBufferCount = 1, .pCommandBuffers = &buffer}, *now.fence);
  now.on_way = device_.frames_on_way = true;
}

void Submissions::mark_frame(Clock::time_point begun, bool kept) {
  submissions_[device_.frame].begun = begun;
  submissions_[device_.frame].kept = kept;
  if (kept) kept_by_ = device_.frame;
}

void Submissions::take_picture(Image& display) {
  misfit_ = (surface_ != nullptr && !surface_->take(display)) || misfit_;
}

void Submissions::finish(std::size_t frame) {
  Submission& submission = submissions_[frame];
  if (!submission.on_way) return;
  wait_for(submission);
  if (surface_ != nullptr) misfit_ = !surface_->show(frame) || misfit_;
  const Clock::time_point now = Clock::now(), from = std::max(submission.begun, std::exchange(done_, now));
  times_ = {.wall_ms = std::chrono::duration<double, std::milli>(now - from).count(),
            .gpu_ms = graph_.total_ms(frame),
            .kept = submission.kept,
            .passes = graph_.timings(frame)};
}

void Submissions::finish() {
  finish(other_frame());
  finish(device_.frame);
}

bool Submissions::finish_within(std::chrono::nanoseconds most) {
  const Clock::time_point until = Clock::now() + most;
  for (const std::size_t frame : {other_frame(), device_.frame}) {
    if (!submissions_[frame].on_way) continue;
    const auto left = std::max(until - Clock::now(), Clock::duration::zero());
    if (device_.device.waitForFences(*submissions_[frame].fence, VK_TRUE, static_cast<std::uint64_t>(left.count())) ==
        vk::Result::eTimeout)
      return false;
    finish(frame);
  }
  return true;
}

void Submissions::finish_kept() {
  if (has_kept()) return;
  if (kept_by_ == device_.frame) finish(other_frame());
  finish(kept_by_);
}

}  // namespace phare::gpu
