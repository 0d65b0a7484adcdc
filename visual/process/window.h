// The window: keys, mouse, title line. GLFW; the renderer presents into it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "config/result.h"
#include "visual/process/cameras.h"
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

  /// Handles what keys and mouse did, camera and view by itself. False once closed.
  bool poll();
  /// The bound keys pressed since the last call; what they do: config/key_bindings.h.
  std::vector<KeyAction> take_presses();
  /// Whether any key was pressed, and what the other processes are to know.
  WindowKeyboard& keyboard();

  CameraKind camera() const;
  void set_camera(CameraKind camera);
  View view() const;
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
