#include "net/window_keys.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "net/channels.h"

namespace phare {

void WindowKeys::take(std::uint32_t channel, std::uint64_t start_id, const KeyInput& keys, WallTime received) {
  OneWindow& window = windows_[channel];
  // Of a window that is new to us everything the message still tells has just been pressed.
  if (window.start_id != start_id) {
    window = {};
    window.start_id = start_id;
    window.events = keys.events - std::min<std::uint64_t>(keys.events, keys.event.size());
  }
  const std::uint64_t news =
      std::min<std::uint64_t>(keys.events - std::min(keys.events, window.events), keys.event.size());
  for (std::size_t i = keys.event.size() - static_cast<std::size_t>(news); i < keys.event.size(); ++i) {
    if (keys.event[i] > 0) presses_.push_back(static_cast<std::uint32_t>(keys.event[i]));
  }
  window.events = std::max(window.events, keys.events);
  window.received = received;
  window.held.reset();
  for (const std::uint32_t key : keys.held) {
    if (key < window.held.size()) window.held.set(key);
  }
}

WindowKeys::Handled WindowKeys::handled(std::uint32_t channel) const {
  const auto window = windows_.find(channel);
  return window == windows_.end() ? Handled{} : Handled{window->second.start_id, window->second.events};
}

void WindowKeys::go_on(std::uint32_t channel, const Handled& handled) {
  if (handled.start_id == 0) return;
  windows_[channel].start_id = handled.start_id;
  windows_[channel].events = handled.events;
}

HeldKeys WindowKeys::held(WallTime now) const {
  HeldKeys all;
  for (const auto& [channel, window] : windows_) {
    const std::chrono::nanoseconds silent(now.ns - window.received.ns);
    if (silent <= channel_of<KeyInput>().stale_after) all |= window.held;
  }
  return all;
}

std::vector<std::uint32_t> WindowKeys::take_presses() {
  return std::exchange(presses_, {});
}

}  // namespace phare
