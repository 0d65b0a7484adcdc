// The barrier of lockstep: nobody goes on to the next frame before every picture has drawn this one. What the
// FrameReports of all channels say together, for cockpit and dynamics alike. Checked by tests/net/lockstep_test.cpp.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "net/bus.h"

namespace phare {

/// The newest frame that any channel has drawn, once all have reported; -1: all are up and none has drawn.
std::optional<std::int64_t> newest_frame_of_all(const Bus& bus);

/// Every channel's newest report is of this frame.
bool all_channels_at(const Bus& bus, std::int64_t frame);

/// The report of a channel whose newest is of this frame; nullptr: of none. Valid until the next poll.
const Bus::Newest<FrameReport>* report_of_frame(const Bus& bus, std::int64_t frame);

/// A channel that asks for what went out already has lost it, or is new: sends the last datagram of this payload again
/// for each channel whose report is of a frame before `sent`.
void send_again_to_late(Bus& bus, std::int64_t sent, std::size_t payload_index);

/// A frame may take minutes, and who waits for it has nothing new to say. So that nobody takes its place as of one who
/// has fallen silent (LiveSender), what it said last goes out again.
class StaysHeard {
 public:
  explicit StaysHeard(std::size_t payload_index) : payload_index_(payload_index) {}

  /// Often: sends again when nothing has gone out for a quarter of the time after which silence counts.
  void step(Bus& bus);

 private:
  std::size_t payload_index_;
  std::uint64_t sent_ = 0;
  std::chrono::steady_clock::time_point since_{};
};

}  // namespace phare
