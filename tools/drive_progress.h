// How far a drive is, on the terminal.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>

#include "net/messages.h"

namespace phare {

/// One line that is written over while the drive goes on; silent when nobody looks at it.
class DriveProgress {
 public:
  explicit DriveProgress(std::int64_t frames_expected)
      : expected_(frames_expected), shown_(isatty(STDERR_FILENO) != 0) {}
  ~DriveProgress() {
    if (written_) std::fputc('\n', stderr);
  }
  void show(const FrameReport& report, std::int64_t frame) {
    if (!shown_ || std::chrono::steady_clock::now() < next_) return;
    next_ = std::chrono::steady_clock::now() + std::chrono::milliseconds(200);
    written_ = true;
    const double percent = expected_ > 0 ? 100.0 * static_cast<double>(frame) / static_cast<double>(expected_) : 0.0;
    std::fprintf(stderr, "\r  frame %lld", static_cast<long long>(frame));
    if (expected_ > 0)
      std::fprintf(stderr, " of %lld  %3.0f %%", static_cast<long long>(expected_), std::min(percent, 100.0));
    std::fprintf(stderr, "  %6.2f ms a frame  %5.1f km/h   ", report.frame_ms, report.drawn.speed_mps * 3.6);
    std::fflush(stderr);
  }

 private:
  std::int64_t expected_;
  bool shown_, written_ = false;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace phare
