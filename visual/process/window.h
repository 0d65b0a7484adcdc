// The window: keys, mouse, title line. GLFW; the renderer presents into it.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "config/base/result.h"
#include "visual/process/pointer_event.h"
#include "visual/process/window_keyboard.h"

struct GLFWwindow;

namespace phare {

/// Width and height of a window of this size, smaller in both where it does not fit the room; no room known: 0.
inline std::pair<int, int> fitted(int width_px, int height_px, int room_width_px, int room_height_px) {
  if (room_width_px <= 0 || room_height_px <= 0) return {width_px, height_px};
  const double scale =
      std::min({1.0, static_cast<double>(room_width_px) / width_px, static_cast<double>(room_height_px) / height_px});
  return {static_cast<int>(width_px * scale), static_cast<int>(height_px * scale)};
}

class Window {
 public:
  /// As large as the screen has room for, at most as given. Error when there is no display.
  static Result<Window> open(const std::string& title, int width_px, int height_px);
  Window(Window&&) noexcept;
  Window& operator=(Window&&) noexcept;
  ~Window();

  /// Handles what keys and mouse did. False once closed.
  bool poll();
  /// The keys that were pressed, and what the other processes are to know of them.
  WindowKeyboard& keyboard();

  struct Mouse {
    double x_px = 0.0, y_px = 0.0;  ///< picture pixels from the top left
    int width_px = 1, height_px = 1;
    bool inside = false;
  };
  Mouse mouse() const;
  /// What it did since the last call, oldest first; of moves in a row the last.
  std::vector<PointerEvent> take_pointer();
  /// What the mouse was moved by since the last call: with the right button held and with the middle one.
  /// Pixels to the right are negative turns: the picture follows the hand; up is positive.
  struct Moves {
    double turn_x_px = 0.0, turn_y_px = 0.0, shift_x_px = 0.0, shift_y_px = 0.0;
  };
  Moves take_moves();
  GLFWwindow* handle() const;

 private:
  struct State;
  explicit Window(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace phare
