#define GLFW_INCLUDE_NONE
#include "engine/render/window.hpp"

#include <array>
#include <atomic>
#include <cstdint>

#include <GLFW/glfw3.h>
#include <fmt/core.h>

namespace septet::render {
namespace {

constexpr std::array<int, key_count> glfw_keys{
    GLFW_KEY_UP, GLFW_KEY_DOWN, GLFW_KEY_LEFT, GLFW_KEY_RIGHT, GLFW_KEY_SPACE, GLFW_KEY_COMMA, GLFW_KEY_PERIOD,
    GLFW_KEY_A,  GLFW_KEY_B,    GLFW_KEY_D,    GLFW_KEY_E,     GLFW_KEY_F,     GLFW_KEY_G,     GLFW_KEY_H,
    GLFW_KEY_L,  GLFW_KEY_M,    GLFW_KEY_P,    GLFW_KEY_Q,     GLFW_KEY_R,     GLFW_KEY_S,     GLFW_KEY_V,
    GLFW_KEY_W,  GLFW_KEY_X,    GLFW_KEY_F1,   GLFW_KEY_ENTER, GLFW_KEY_ESCAPE};

std::string glfw_error() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : "GLFW gave no reason";
}

}  // namespace

struct Window::Glfw {
  GLFWwindow* window = nullptr;
  bool initialised = false;
  bool touched = false;
  std::atomic<std::uint32_t> width{0}, height{0};
  void take_size(int width_px, int height_px) {
    width = static_cast<std::uint32_t>(width_px);
    height = static_cast<std::uint32_t>(height_px);
  }
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
    return failure("the display cannot show Vulkan pictures", "display",
                   "install mesa-vulkan-drivers, or use --virtual");
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  GLFWmonitor* monitor = nullptr;
  int width = static_cast<int>(options.width), height = static_cast<int>(options.height);
  int count = 0;
  GLFWmonitor** monitors = glfwGetMonitors(&count);
  const std::uint32_t wanted = options.monitor.value_or(0);
  const bool is_there = wanted < static_cast<std::uint32_t>(count);
  if (options.full_screen) {
    if (!is_there)
      return failure(fmt::format("there are {} monitors, and none with index {}", count, wanted), "display",
                     "connect it, or name another monitor in the rig");
    monitor = monitors[wanted];
    // The monitor keeps its own resolution and rate.
    const GLFWvidmode* mode = glfwGetVideoMode(monitor);
    width = mode->width;
    height = mode->height;
    glfwWindowHint(GLFW_REFRESH_RATE, mode->refreshRate);
    glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);
  }
  const bool placed = !options.full_screen && options.monitor && count > 0;
  glfwWindowHint(GLFW_VISIBLE, placed ? GLFW_FALSE : GLFW_TRUE);
  glfw->window = glfwCreateWindow(width, height, options.title.c_str(), monitor, nullptr);
  if (!glfw->window) return failure("no window can be opened: " + glfw_error(), "display", "use --virtual");
  if (placed) {
    int left = 0, top = 0;
    glfwGetMonitorWorkarea(monitors[is_there ? wanted : 0], &left, &top, nullptr, nullptr);
    const int step = is_there ? 0 : 48 * static_cast<int>(wanted);
    glfwSetWindowPos(glfw->window, left + step, top + step);
    glfwShowWindow(glfw->window);
  }
  glfwSetInputMode(glfw->window, GLFW_STICKY_KEYS, GLFW_TRUE);
  glfwSetWindowUserPointer(glfw->window, glfw.get());
  glfwSetKeyCallback(glfw->window, [](GLFWwindow* window, int key, int, int action, int) {
    if (action == GLFW_PRESS && key != GLFW_KEY_F1 && key != GLFW_KEY_ENTER && key != GLFW_KEY_ESCAPE)
      static_cast<Glfw*>(glfwGetWindowUserPointer(window))->touched = true;
  });
  int width_px = 0, height_px = 0;
  glfwGetFramebufferSize(glfw->window, &width_px, &height_px);
  glfw->take_size(width_px, height_px);
  glfwSetFramebufferSizeCallback(glfw->window, [](GLFWwindow* window, int new_width_px, int new_height_px) {
    static_cast<Glfw*>(glfwGetWindowUserPointer(window))->take_size(new_width_px, new_height_px);
  });
  if (monitor) glfwSetInputMode(glfw->window, GLFW_CURSOR, GLFW_CURSOR_HIDDEN);
  return Window(std::move(glfw));
}

void Window::poll() { glfwPollEvents(); }
bool Window::should_close() const { return glfwWindowShouldClose(glfw_->window); }
bool Window::is_down(Key key) const {
  return glfwGetKey(glfw_->window, glfw_keys[static_cast<std::size_t>(key)]) == GLFW_PRESS;
}
bool Window::was_touched() const { return glfw_->touched; }

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

std::uint32_t Window::width() const { return glfw_->width; }
std::uint32_t Window::height() const { return glfw_->height; }

std::array<int, 2> Window::place() const {
  std::array<int, 2> corner{};
  glfwGetWindowPos(glfw_->window, &corner[0], &corner[1]);
  return corner;
}

void* Window::handle() const { return glfw_->window; }

}  // namespace septet::render
