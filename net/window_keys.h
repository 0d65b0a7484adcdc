// The keys of the windows, from KeyInput messages: what is held now, and what was pressed since the last look. A
// message that is lost leaves no key stuck and loses no press; a window that is gone, or has lost the focus, holds
// nothing. Tests: tests/net/window_keys_test.cpp.
#pragma once

#include <bitset>
#include <cstdint>
#include <map>
#include <vector>

#include "net/messages.h"

namespace phare {

/// By key, as they stand in KeyInput.
using HeldKeys = std::bitset<512>;

class WindowKeys {
 public:
  /// `start_id`: of the sender; a new one is a new window, whose count begins anew.
  void take(std::uint32_t channel, std::uint64_t start_id, const KeyInput& keys, WallTime received);

  /// Of all windows; those of a window that has been silent for a second are left out.
  HeldKeys held(WallTime now) const;
  /// How far the presses of a window have been handled: 0 and 0 of one that has not been heard.
  struct Handled {
    std::uint64_t start_id = 0, events = 0;
  };
  Handled handled(std::uint32_t channel) const;
  /// Goes on where another one stood: presses that it has handled do not come again, those since then do.
  void go_on(std::uint32_t channel, const Handled& handled);

  /// Presses since the last call, oldest first.
  std::vector<std::uint32_t> take_presses();

 private:
  struct OneWindow {
    std::uint64_t start_id = 0;
    std::uint64_t events = 0;  // handled so far
    WallTime received;
    HeldKeys held;
  };
  std::map<std::uint32_t, OneWindow> windows_;  // by channel: a rig has few
  std::vector<std::uint32_t> presses_;
};

}  // namespace phare
