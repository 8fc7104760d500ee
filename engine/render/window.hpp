#pragma once
/// Window or full screen, with keyboard and gamepad, by way of GLFW. Only desktops and projectors need one; a virtual
/// screen does not use this file.
///
/// All calls except those for the size come from the program's main thread.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "engine/core/expected.hpp"
#include "engine/world/key.hpp"

namespace septet::render {

struct WindowOptions {
  std::string title = "Septet";
  std::uint32_t width = 1280, height = 720;
  /// Index; empty: the first monitor for a full screen, the system's choice for a window.
  std::optional<std::uint32_t> monitor;
  bool full_screen = false;  ///< Covers the monitor, in its own resolution and rate.
};

/// First gamepad: sticks in [−1, 1] (right and down positive), triggers in [0, 1].
struct Gamepad {
  float left_x = 0.0f, left_y = 0.0f, right_x = 0.0f, right_y = 0.0f;
  float left_trigger = 0.0f, right_trigger = 0.0f;
  bool a = false, b = false, x = false, y = false, left_bumper = false, right_bumper = false;
};

class Window {
 public:
  /// Opens a window. One whose monitor is missing stands on the first monitor, each further index a little lower and to
  /// the right, so that the windows of a rig do not hide each other. A full screen without its monitor is an error.
  static Expected<Window> open(const WindowOptions& options);
  Window(Window&&) noexcept;
  Window& operator=(Window&&) noexcept;
  ~Window();

  /// Handles the system's events; call it once a frame.
  void poll();
  bool should_close() const;
  /// True if the key is down, or was pressed and released since the last query: a slow frame misses no key.
  bool is_down(Key key) const;
  /// True if any key but F1, Enter and Escape has been pressed since the window opened.
  bool was_touched() const;
  std::optional<Gamepad> gamepad() const;
  /// Size of the picture at the last poll, pixels; callable from any thread.
  std::uint32_t width() const;
  std::uint32_t height() const;

  /// Upper left corner of the picture on the desktop, pixels.
  std::array<int, 2> place() const;

  /// GLFWwindow, for the renderer's surface.
  void* handle() const;

 private:
  struct Glfw;
  explicit Window(std::unique_ptr<Glfw> glfw);
  std::unique_ptr<Glfw> glfw_;
};

}  // namespace septet::render
