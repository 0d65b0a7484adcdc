// The passes of one frame, in order. A pass says which images it reads and writes; barriers, debug labels and time
// stamps follow from that.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "visual/gpu/device.h"

namespace phare::gpu {

enum class Use { kColourTarget, kDepthTarget, kDepthRead, kSampled, kCopySource, kCopyTarget, kPresent };

struct ImageUse {
  Image* image = nullptr;
  Use use = Use::kColourTarget;
  bool discard = false;  ///< what was in it is not needed
};

class FrameGraph {
 public:
  explicit FrameGraph(Device& device);

  /// Starts a frame: records into `commands` from here on.
  void begin(vk::CommandBuffer commands);
  /// One pass: barriers for its images, then `record`, between two time stamps.
  void pass(const std::string& name, const std::vector<ImageUse>& uses,
            const std::function<void(vk::CommandBuffer)>& record);
  void end();

  struct Timing {
    std::string name;
    double ms = 0.0;
  };
  /// After the GPU is done: milliseconds of each pass of the last frame.
  std::vector<Timing> timings() const;
  /// From the first to the last time stamp, ms.
  double total_ms() const;

 private:
  Device& device_;
  vk::raii::QueryPool stamps_{nullptr};
  vk::CommandBuffer commands_;
  std::vector<std::string> names_;
};

}  // namespace phare::gpu
