// The window: keys, mouse, title line. GLFW; the renderer presents into it.
#pragma once

#include <memory>
#include <string>

#include "config/result.h"
#include "visual/process/window_keyboard.h"

struct GLFWwindow;

namespace phare {

class Window {
 public:
  /// Error when there is no display.
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
  GLFWwindow* handle() const;

 private:
  struct State;
  explicit Window(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace phare
