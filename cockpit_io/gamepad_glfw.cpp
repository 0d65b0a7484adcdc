// The device behind GamepadSource. Built with PHARE_GRAPHICS only: GLFW needs a display even to read joysticks.
#include "cockpit_io/gamepad_source.h"

#ifdef PHARE_HAS_GLFW
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#endif

#include <string>

namespace phare {

#ifdef PHARE_HAS_GLFW

namespace {

/// GLFW as long as a reader lives.
struct Glfw {
  bool started = glfwInit() == GLFW_TRUE;
  ~Glfw() {
    if (started) glfwTerminate();
  }
};

std::optional<GamepadReading> read(const std::string& name) {
  glfwPollEvents();  // notices devices that come and go
  for (int id = GLFW_JOYSTICK_1; id <= GLFW_JOYSTICK_LAST; ++id) {
    if (glfwJoystickPresent(id) == GLFW_FALSE) continue;
    const char* called = glfwGetJoystickName(id);
    if (called == nullptr || std::string(called).find(name) == std::string::npos) continue;
    GamepadReading reading;
    int count = 0;
    if (const float* axes = glfwGetJoystickAxes(id, &count)) reading.axes.assign(axes, axes + count);
    if (const unsigned char* buttons = glfwGetJoystickButtons(id, &count))
      reading.buttons.assign(buttons, buttons + count);
    if (const unsigned char* hats = glfwGetJoystickHats(id, &count)) reading.hats.assign(hats, hats + count);
    return reading;
  }
  return std::nullopt;
}

std::optional<PadReading> read_any() {
  glfwPollEvents();
  GLFWgamepadstate state{};
  for (int id = GLFW_JOYSTICK_1; id <= GLFW_JOYSTICK_LAST; ++id) {
    // Only what GLFW knows: axes of anything else (a wheel, a keyboard that calls itself a joystick) could mean
    // anything.
    if (glfwJoystickIsGamepad(id) == GLFW_FALSE || glfwGetGamepadState(id, &state) == GLFW_FALSE) continue;
    PadReading reading;
    const auto pedal = [&](int axis) { return 0.5 * (static_cast<double>(state.axes[axis]) + 1.0); };
    reading.left_m1_1 = -static_cast<double>(state.axes[GLFW_GAMEPAD_AXIS_LEFT_X]);
    reading.accelerator_01 = pedal(GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER);
    reading.brake_01 = pedal(GLFW_GAMEPAD_AXIS_LEFT_TRIGGER);
    for (const PadBinding& binding : pad_bindings()) {
      const bool pressed = state.buttons[binding.button] == GLFW_PRESS;
      bool& held = reading.pressed[static_cast<std::size_t>(binding.action)];
      held = held || pressed;
    }
    return reading;
  }
  return std::nullopt;
}

}  // namespace

std::function<std::optional<PadReading>()> open_any_gamepad() {
  auto glfw = std::make_shared<Glfw>();
  if (!glfw->started) return {};
  return [glfw] { return read_any(); };
}

Result<GamepadSource::Reader> open_glfw_gamepad(const std::string& name) {
  glfwInitHint(GLFW_JOYSTICK_HAT_BUTTONS, GLFW_FALSE);
  auto glfw = std::make_shared<Glfw>();
  if (!glfw->started) {
    const char* why = nullptr;
    glfwGetError(&why);
    return Error{"gamepad", std::string("GLFW does not start: ") + (why != nullptr ? why : "no reason given") +
                                "; it reads gamepads only where there is a display"};
  }
  return GamepadSource::Reader([glfw, name] { return read(name); });
}

#else

std::function<std::optional<PadReading>()> open_any_gamepad() {
  return {};
}

Result<GamepadSource::Reader> open_glfw_gamepad(const std::string&) {
  return Error{"gamepad", "this build has no GLFW (PHARE_GRAPHICS is off)"};
}

#endif

}  // namespace phare
