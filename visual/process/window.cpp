#include "visual/process/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <utility>

#include "config/remedies.h"

namespace phare {

struct Window::State {
  GLFWwindow* window = nullptr;
  CameraKind camera = CameraKind::kDriver;
  View view = View::kPhoto;

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (window != nullptr) glfwDestroyWindow(window);
    glfwTerminate();
  }

  static void on_key(GLFWwindow* window, int key, int, int action, int) {
    if (action != GLFW_PRESS) return;
    State& state = *static_cast<State*>(glfwGetWindowUserPointer(window));
    if (key == GLFW_KEY_ESCAPE) glfwSetWindowShouldClose(window, GLFW_TRUE);
    if (key == GLFW_KEY_F) state.view = state.view == View::kPhoto ? View::kFalseColour : View::kPhoto;
    if (key == GLFW_KEY_C) state.camera = static_cast<CameraKind>((static_cast<int>(state.camera) + 1) % 3);
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
  state->window = glfwCreateWindow(width_px, height_px, title.c_str(), nullptr, nullptr);
  if (state->window == nullptr) {
    glfwGetError(&reason);
    return Error{"window", std::string("cannot be opened: ") + (reason != nullptr ? reason : "GLFW")};
  }
  glfwSetWindowUserPointer(state->window, state.get());
  glfwSetKeyCallback(state->window, State::on_key);
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

CameraKind Window::camera() const {
  return state_->camera;
}
void Window::set_camera(CameraKind camera) {
  state_->camera = camera;
}
View Window::view() const {
  return state_->view;
}
GLFWwindow* Window::handle() const {
  return state_->window;
}

Window::Mouse Window::mouse() const {
  // GLFW speaks in screen coordinates; the picture has as many pixels as the framebuffer.
  int window_width = 1, window_height = 1;
  Mouse mouse;
  glfwGetWindowSize(state_->window, &window_width, &window_height);
  glfwGetFramebufferSize(state_->window, &mouse.width_px, &mouse.height_px);
  glfwGetCursorPos(state_->window, &mouse.x_px, &mouse.y_px);
  if (window_width < 1 || window_height < 1 || mouse.width_px < 1 || mouse.height_px < 1) return {};
  mouse.inside = mouse.x_px >= 0 && mouse.y_px >= 0 && mouse.x_px < window_width && mouse.y_px < window_height;
  mouse.x_px *= static_cast<double>(mouse.width_px) / window_width;
  mouse.y_px *= static_cast<double>(mouse.height_px) / window_height;
  return mouse;
}

}  // namespace phare
