#include "visual/gpu/staging.h"

#include <algorithm>
#include <cstring>

namespace phare::gpu {

void Staging::begin_frame() {
  const std::size_t needed = used_ > 0 ? page_ + 1 : page_;
  if (needed < pages_.size()) pages_.erase(pages_.begin() + static_cast<std::ptrdiff_t>(needed), pages_.end());
  page_ = 0;
  used_ = 0;
}

Staging::Place Staging::put(Device& device, std::span<const std::byte> bytes) {
  while (page_ < pages_.size() && used_ + bytes.size() > pages_[page_].bytes) {
    ++page_;
    used_ = 0;
  }
  if (page_ == pages_.size())
    pages_.emplace_back(device, std::max<vk::DeviceSize>(kPage, bytes.size()), vk::BufferUsageFlagBits::eTransferSrc,
                        "staging");
  const Place place{*pages_[page_].buffer, used_};
  std::memcpy(static_cast<std::byte*>(pages_[page_].data) + used_, bytes.data(), bytes.size());
  used_ = (used_ + bytes.size() + 15) / 16 * 16;
  return place;
}

}  // namespace phare::gpu
