#include "net/lockstep.h"

#include <algorithm>

namespace phare {

std::optional<std::int64_t> newest_frame_of_all(const Bus& bus) {
  std::int64_t newest = -1;
  for (std::uint32_t channel = 0; channel < bus.channels(); ++channel) {
    const auto* report = bus.newest<FrameReport>(channel);
    if (report == nullptr) return std::nullopt;
    newest = std::max(newest, report->value.frame_index);
  }
  return newest;
}

bool all_channels_at(const Bus& bus, std::int64_t frame) {
  for (std::uint32_t channel = 0; channel < bus.channels(); ++channel) {
    const auto* report = bus.newest<FrameReport>(channel);
    if (report == nullptr || report->value.frame_index != frame) return false;
  }
  return true;
}

const Bus::Newest<FrameReport>* report_of_frame(const Bus& bus, std::int64_t frame) {
  for (std::uint32_t channel = 0; channel < bus.channels(); ++channel) {
    const auto* report = bus.newest<FrameReport>(channel);
    if (report != nullptr && report->value.frame_index == frame) return report;
  }
  return nullptr;
}

void send_again_to_late(Bus& bus, std::int64_t sent, std::size_t payload_index) {
  for (std::uint32_t channel = 0; channel < bus.channels(); ++channel) {
    const auto report = bus.take<FrameReport>(channel);
    if (report && report->value.frame_index < sent) bus.send_again(payload_index);
  }
}

void StaysHeard::step(Bus& bus) {
  const auto now = std::chrono::steady_clock::now();
  const std::uint64_t sent = bus.counters().sent[payload_index_];
  if (sent == sent_ && now - since_ < taken_over_after(kChannels[payload_index_]) / 4) return;
  if (sent == sent_) bus.send_again(payload_index_);
  sent_ = sent;
  since_ = now;
}

}  // namespace phare
