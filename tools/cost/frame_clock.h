// What a frame takes: on a software device time of the processor, all threads together, which others' work disturbs
// least; on a GPU, whose work takes none of that, of the whole frame.
#pragma once

#include <time.h>

#include <string>

#include "visual/renderer.h"
#include "visual/vulkan_devices.h"

namespace phare::cost {

class FrameClock {
 public:
  FrameClock() {
    const Result<VulkanDevice> device = vulkan_device("");
    on_processor_ = device && device->software;
  }

  bool on_processor() const { return on_processor_; }
  std::string unit() const { return on_processor_ ? "ms of processor a frame" : "ms a frame"; }

  double draw_ms(Renderer& renderer, const FrameInput& input) const {
    const double begin_ms = processor_ms();
    const double wall_ms = renderer.draw(input).wall_ms;
    return on_processor_ ? processor_ms() - begin_ms : wall_ms;
  }

 private:
  static double processor_ms() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
  }

  bool on_processor_ = true;
};

}  // namespace phare::cost
