#pragma once
/// A window or a full screen, with keyboard and gamepad, by way of GLFW. Only desktops and projectors need one; a virtual
/// screen never comes near this file.
///
/// All calls come from the program's main thread.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "engine/core/expected.hpp"

namespace septet::render {

struct WindowOptions {
  std::string title = "Septet";
  std::uint32_t width = 1280, height = 720;
  std::optional<std::uint32_t> full_screen_on;  ///< Index of the display; nothing: a window.
};

enum class Key : std::uint8_t {
  left, right, up, down, space, enter, escape, tab, left_shift, left_control,
  a, d, e, f, h, l, m, q, r, s, w, x, z, comma, period, f11,
};

/// The first gamepad: sticks in [−1, 1] (right and down positive), triggers in [0, 1].
struct Gamepad {
  float left_x = 0.0f, left_y = 0.0f, right_x = 0.0f, right_y = 0.0f;
  float left_trigger = 0.0f, right_trigger = 0.0f;
  bool a = false, b = false, x = false, y = false, left_bumper = false, right_bumper = false;
};

class Window {
 public:
  static Expected<Window> open(const WindowOptions& options);
  Window(Window&&) noexcept;
  Window& operator=(Window&&) noexcept;
  ~Window();

  /// Takes what the system has to say; call it once a frame.
  void poll();
  bool should_close() const;
  bool is_down(Key key) const;
  std::optional<Gamepad> gamepad() const;
  /// Size of the picture, pixels.
  std::uint32_t width() const;
  std::uint32_t height() const;

  /// The GLFWwindow, for the renderer's surface.
  void* handle() const;

 private:
  struct Glfw;
  explicit Window(std::unique_ptr<Glfw> glfw);
  std::unique_ptr<Glfw> glfw_;
};

}  // namespace septet::render
