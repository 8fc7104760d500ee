#define GLFW_INCLUDE_NONE
#include "engine/render/window.hpp"

#include <array>

#include <GLFW/glfw3.h>

namespace septet::render {
namespace {

constexpr std::array<int, 26> glfw_keys{
    GLFW_KEY_LEFT, GLFW_KEY_RIGHT, GLFW_KEY_UP, GLFW_KEY_DOWN, GLFW_KEY_SPACE, GLFW_KEY_ENTER, GLFW_KEY_ESCAPE,
    GLFW_KEY_TAB, GLFW_KEY_LEFT_SHIFT, GLFW_KEY_LEFT_CONTROL, GLFW_KEY_A, GLFW_KEY_D, GLFW_KEY_E, GLFW_KEY_F,
    GLFW_KEY_H, GLFW_KEY_L, GLFW_KEY_M, GLFW_KEY_Q, GLFW_KEY_R, GLFW_KEY_S, GLFW_KEY_W, GLFW_KEY_X, GLFW_KEY_Z,
    GLFW_KEY_COMMA, GLFW_KEY_PERIOD, GLFW_KEY_F11};

std::string glfw_error() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : "GLFW gave no reason";
}

}  // namespace

struct Window::Glfw {
  GLFWwindow* window = nullptr;
  bool initialised = false;
  ~Glfw() {
    if (window) glfwDestroyWindow(window);
    if (initialised) glfwTerminate();
  }
};

Window::Window(std::unique_ptr<Glfw> glfw) : glfw_(std::move(glfw)) {}
Window::Window(Window&&) noexcept = default;
Window& Window::operator=(Window&&) noexcept = default;
Window::~Window() = default;

Expected<Window> Window::open(const WindowOptions& options) {
  auto glfw = std::make_unique<Glfw>();
  if (!glfwInit())
    return failure("no window can be opened: " + glfw_error(), "display",
                   "start it in a graphical session, or use --virtual");
  glfw->initialised = true;
  if (!glfwVulkanSupported())
    return failure("the display cannot show Vulkan pictures", "display", "install mesa-vulkan-drivers, or use --virtual");
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  GLFWmonitor* monitor = nullptr;
  int width = static_cast<int>(options.width), height = static_cast<int>(options.height);
  if (options.full_screen_on) {
    int count = 0;
    GLFWmonitor** monitors = glfwGetMonitors(&count);
    if (*options.full_screen_on >= static_cast<std::uint32_t>(count))
      return failure("there are " + std::to_string(count) + " displays, not one with index " +
                         std::to_string(*options.full_screen_on), "display", "connect it, or name another display");
    monitor = monitors[*options.full_screen_on];
    // The display keeps its own resolution and rate.
    const GLFWvidmode* mode = glfwGetVideoMode(monitor);
    width = mode->width;
    height = mode->height;
    glfwWindowHint(GLFW_REFRESH_RATE, mode->refreshRate);
    glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);
  }
  glfw->window = glfwCreateWindow(width, height, options.title.c_str(), monitor, nullptr);
  if (!glfw->window) return failure("no window can be opened: " + glfw_error(), "display", "use --virtual");
  if (monitor) glfwSetInputMode(glfw->window, GLFW_CURSOR, GLFW_CURSOR_HIDDEN);
  return Window(std::move(glfw));
}

void Window::poll() { glfwPollEvents(); }
bool Window::should_close() const { return glfwWindowShouldClose(glfw_->window); }
bool Window::is_down(Key key) const {
  return glfwGetKey(glfw_->window, glfw_keys[static_cast<std::size_t>(key)]) == GLFW_PRESS;
}

std::optional<Gamepad> Window::gamepad() const {
  for (int joystick = GLFW_JOYSTICK_1; joystick <= GLFW_JOYSTICK_LAST; ++joystick) {
    GLFWgamepadstate state;
    if (!glfwJoystickIsGamepad(joystick) || !glfwGetGamepadState(joystick, &state)) continue;
    Gamepad pad;
    pad.left_x = state.axes[GLFW_GAMEPAD_AXIS_LEFT_X];
    pad.left_y = state.axes[GLFW_GAMEPAD_AXIS_LEFT_Y];
    pad.right_x = state.axes[GLFW_GAMEPAD_AXIS_RIGHT_X];
    pad.right_y = state.axes[GLFW_GAMEPAD_AXIS_RIGHT_Y];
    pad.left_trigger = 0.5f + 0.5f * state.axes[GLFW_GAMEPAD_AXIS_LEFT_TRIGGER];
    pad.right_trigger = 0.5f + 0.5f * state.axes[GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER];
    pad.a = state.buttons[GLFW_GAMEPAD_BUTTON_A];
    pad.b = state.buttons[GLFW_GAMEPAD_BUTTON_B];
    pad.x = state.buttons[GLFW_GAMEPAD_BUTTON_X];
    pad.y = state.buttons[GLFW_GAMEPAD_BUTTON_Y];
    pad.left_bumper = state.buttons[GLFW_GAMEPAD_BUTTON_LEFT_BUMPER];
    pad.right_bumper = state.buttons[GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER];
    return pad;
  }
  return std::nullopt;
}

std::uint32_t Window::width() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(glfw_->window, &width, &height);
  return static_cast<std::uint32_t>(width);
}

std::uint32_t Window::height() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(glfw_->window, &width, &height);
  return static_cast<std::uint32_t>(height);
}

void* Window::handle() const { return glfw_->window; }

}  // namespace septet::render
