// The keyboard of a window: from what GLFW tells to what the window does itself, and to the KeyInput that goes to the
// cockpit and to the launcher. Knows no GLFW, so that it is tested without a window:
// tests/visual_process/screens_test.cpp.
#pragma once

#include <chrono>
#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "config/key_bindings.h"
#include "net/messages.h"

namespace phare {

class WindowKeyboard {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// While something is held, and for a second after the newest event, this often.
  static constexpr std::chrono::milliseconds kSendEvery{20};
  static constexpr std::chrono::milliseconds kTell{1000};

  /// A key goes down or up. `physical`: the same number both times, whatever Shift does in between; `code`: what it is
  /// bound as (any number where it is bound as nothing). A repeat is no press.
  void key(int physical, KeyCode code, bool down, Time now);
  /// A key is held and repeats: a press of those that move something step by step (repeats()).
  void repeat(KeyCode code);
  /// A character was typed that no single key stands for everywhere: a press and its release.
  void character(KeyCode code, Time now);
  /// Nothing is held any more.
  void focus_lost(Time now);

  /// Bound keys pressed since the last call, oldest first.
  std::vector<KeyAction> take_presses();
  /// Whether any key at all was, since the last call.
  bool take_any();
  /// What is to be sent now, if anything.
  std::optional<KeyInput> message(Time now);

 private:
  struct Event {
    std::int32_t event;
    Time at;
  };
  void tell(std::int32_t event, Time now);

  std::map<int, KeyCode> down_;  // by physical key; bound keys that leave the window only
  std::deque<Event> events_;     // of the last second
  std::uint64_t count_ = 0;
  std::vector<KeyAction> presses_;
  bool any_ = false, news_ = false;
  Time sent_{};
};

}  // namespace phare
