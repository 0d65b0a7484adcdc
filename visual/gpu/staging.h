// Bytes on their way to the device: written now, copied by commands of the same frame, so nothing waits.
#pragma once

#include <span>
#include <vector>

#include "visual/gpu/device.h"

namespace phare::gpu {

class Staging {
 public:
  /// What was put before has been copied: its room is used again, and freed where the frame before had no need of it.
  void begin_frame();

  struct Place {
    vk::Buffer buffer{};
    vk::DeviceSize offset = 0;  ///< a multiple of 16
  };
  Place put(Device& device, std::span<const std::byte> bytes);

 private:
  static constexpr vk::DeviceSize kPage = 1 << 20;  // a beam of 256 x 128 nodes takes half of it

  std::vector<HostBuffer> pages_;
  std::size_t page_ = 0;     ///< being filled
  vk::DeviceSize used_ = 0;  ///< of it
};

}  // namespace phare::gpu
