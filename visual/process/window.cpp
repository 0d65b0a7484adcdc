#include "visual/process/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "config/base/remedies.h"

namespace phare {

namespace {

// The table speaks of keys by GLFW's numbers without knowing GLFW.
static_assert(key::kEscape == GLFW_KEY_ESCAPE && key::kBackspace == GLFW_KEY_BACKSPACE && key::kF1 == GLFW_KEY_F1 &&
              key::kF2 == GLFW_KEY_F2 && key::kF3 == GLFW_KEY_F3 && key::kF4 == GLFW_KEY_F4 &&
              key::kF5 == GLFW_KEY_F5 && key::kF6 == GLFW_KEY_F6 && key::kF7 == GLFW_KEY_F7 &&
              key::kF8 == GLFW_KEY_F8 && key::kF9 == GLFW_KEY_F9);
static_assert(key::kPageUp == GLFW_KEY_PAGE_UP && key::kPageDown == GLFW_KEY_PAGE_DOWN && key::kHome == GLFW_KEY_HOME &&
              key::kEnd == GLFW_KEY_END);
static_assert(key::kUp == GLFW_KEY_UP && key::kDown == GLFW_KEY_DOWN && key::kLeft == GLFW_KEY_LEFT &&
              key::kRight == GLFW_KEY_RIGHT);

/// Letters and signs by what is printed on this keyboard, so that a key is the same here and in the terminal; where
/// that is no Latin letter, by its place on an American one.
KeyCode code_of(int glfw_key, int scancode, int mods) {
  const char* printed = glfwGetKeyName(glfw_key, scancode);
  const bool latin = printed != nullptr && printed[0] > ' ' && printed[1] == '\0';
  KeyCode code = latin ? static_cast<KeyCode>(printed[0]) : static_cast<KeyCode>(std::max(glfw_key, 0));
  const bool shift = (mods & GLFW_MOD_SHIFT) != 0;
  if (glfw_key >= GLFW_KEY_KP_0 && glfw_key <= GLFW_KEY_KP_9)
    code = static_cast<KeyCode>('0' + glfw_key - GLFW_KEY_KP_0);
  if (code >= 'A' && code <= 'Z' && !shift) code = code - 'A' + 'a';
  if (code >= 'a' && code <= 'z' && shift) code = code - 'a' + 'A';
  return code;
}

}  // namespace

struct Window::State {
  GLFWwindow* window = nullptr;
  WindowKeyboard keyboard;
  std::vector<PointerEvent> pointer;
  Moves moves;
  double mouse_x = 0.0, mouse_y = 0.0;

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (window != nullptr) glfwDestroyWindow(window);
    glfwTerminate();
  }

  /// In pixels of the picture: GLFW speaks in screen coordinates.
  std::pair<double, double> px_per_unit() const {
    int width = 1, height = 1, width_px = 1, height_px = 1;
    glfwGetWindowSize(window, &width, &height);
    glfwGetFramebufferSize(window, &width_px, &height_px);
    return {static_cast<double>(width_px) / std::max(width, 1), static_cast<double>(height_px) / std::max(height, 1)};
  }
  void point(PointerEvent event) {
    glfwGetCursorPos(window, &event.x_px, &event.y_px);
    const auto [across, down] = px_per_unit();
    event.x_px *= across, event.y_px *= down;
    constexpr auto kMove = PointerEvent::Kind::kMove;
    if (event.kind == kMove && !pointer.empty() && pointer.back().kind == kMove) pointer.pop_back();
    pointer.push_back(event);
  }

  static State& of(GLFWwindow* window) { return *static_cast<State*>(glfwGetWindowUserPointer(window)); }
  static void on_key(GLFWwindow* window, int key, int scancode, int action, int mods) {
    if (action == GLFW_REPEAT) return of(window).keyboard.repeat(code_of(key, scancode, mods));
    const int physical = key == GLFW_KEY_UNKNOWN ? GLFW_KEY_LAST + 1 + scancode : key;
    of(window).keyboard.key(physical, code_of(key, scancode, mods), action == GLFW_PRESS,
                            WindowKeyboard::Time::clock::now());
  }
  static void on_button(GLFWwindow* window, int button, int action, int) {
    using Button = PointerEvent::Button;
    if (button > GLFW_MOUSE_BUTTON_MIDDLE) return;
    of(window).point({.kind = action == GLFW_PRESS ? PointerEvent::Kind::kPress : PointerEvent::Kind::kRelease,
                      .button = button == GLFW_MOUSE_BUTTON_LEFT    ? Button::kLeft
                                : button == GLFW_MOUSE_BUTTON_RIGHT ? Button::kRight
                                                                    : Button::kMiddle});
  }
  static void on_wheel(GLFWwindow* window, double, double lines) {
    of(window).point({.kind = PointerEvent::Kind::kWheel, .wheel = lines});
  }
  static void on_mouse(GLFWwindow* window, double x, double y) {
    State& state = of(window);
    const double right = x - std::exchange(state.mouse_x, x), down = y - std::exchange(state.mouse_y, y);
    const auto held = [&](int button) { return glfwGetMouseButton(window, button) == GLFW_PRESS; };
    if (held(GLFW_MOUSE_BUTTON_RIGHT)) state.moves.turn_x_px -= right, state.moves.turn_y_px -= down;
    if (held(GLFW_MOUSE_BUTTON_MIDDLE)) state.moves.shift_x_px += right, state.moves.shift_y_px += down;
    state.point({.kind = PointerEvent::Kind::kMove});
  }
  static void on_character(GLFWwindow* window, unsigned character) {
    // On every keyboard another key with Shift.
    if (character == '?') of(window).keyboard.character('?', WindowKeyboard::Time::clock::now());
  }
  static void on_focus(GLFWwindow* window, int focused) {
    if (focused == GLFW_FALSE) of(window).keyboard.focus_lost(WindowKeyboard::Time::clock::now());
  }
};

Result<Window> Window::open(const std::string& title, int width_px, int height_px) {
  const char* reason = nullptr;
  if (glfwInit() != GLFW_TRUE) {
    glfwGetError(&reason);
    return Error{"window", std::string("no display (") + (reason != nullptr ? reason : "GLFW") +
                               "); --headless draws without one; or " + kDisplayRemedy};
  }
  auto state = std::make_unique<State>();
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  int x = 0, y = 0, room_width_px = 0, room_height_px = 0;
  if (GLFWmonitor* monitor = glfwGetPrimaryMonitor())
    glfwGetMonitorWorkarea(monitor, &x, &y, &room_width_px, &room_height_px);
  std::tie(width_px, height_px) = fitted(width_px, height_px, room_width_px, room_height_px);
  state->window = glfwCreateWindow(width_px, height_px, title.c_str(), nullptr, nullptr);
  if (state->window == nullptr) {
    glfwGetError(&reason);
    return Error{"window", std::string("cannot be opened: ") + (reason != nullptr ? reason : "GLFW")};
  }
  glfwSetWindowUserPointer(state->window, state.get());
  glfwSetKeyCallback(state->window, State::on_key);
  glfwSetScrollCallback(state->window, State::on_wheel);
  glfwSetCursorPosCallback(state->window, State::on_mouse);
  glfwSetMouseButtonCallback(state->window, State::on_button);
  glfwSetCharCallback(state->window, State::on_character);
  glfwSetWindowFocusCallback(state->window, State::on_focus);
  return Window(std::move(state));
}

Window::Window(std::unique_ptr<State> state) : state_(std::move(state)) {}
Window::Window(Window&&) noexcept = default;
Window& Window::operator=(Window&&) noexcept = default;
Window::~Window() = default;

bool Window::poll() {
  glfwPollEvents();
  return glfwWindowShouldClose(state_->window) == GLFW_FALSE;
}

std::vector<PointerEvent> Window::take_pointer() {
  return std::exchange(state_->pointer, {});
}
Window::Moves Window::take_moves() {
  return std::exchange(state_->moves, {});
}

WindowKeyboard& Window::keyboard() {
  return state_->keyboard;
}

GLFWwindow* Window::handle() const {
  return state_->window;
}

Window::Mouse Window::mouse() const {
  int window_width = 1, window_height = 1;
  Mouse mouse;
  glfwGetWindowSize(state_->window, &window_width, &window_height);
  glfwGetFramebufferSize(state_->window, &mouse.width_px, &mouse.height_px);
  glfwGetCursorPos(state_->window, &mouse.x_px, &mouse.y_px);
  if (window_width < 1 || window_height < 1 || mouse.width_px < 1 || mouse.height_px < 1) return {};
  mouse.inside = mouse.x_px >= 0 && mouse.y_px >= 0 && mouse.x_px < window_width && mouse.y_px < window_height;
  const auto [across, down] = state_->px_per_unit();
  mouse.x_px *= across, mouse.y_px *= down;
  return mouse;
}

}  // namespace phare
