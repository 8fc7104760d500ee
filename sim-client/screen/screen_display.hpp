#pragma once
/// Output of a screen's picture: a window, a whole monitor, or memory alone. And the keys pressed on it.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "engine/core/expected.hpp"
#include "engine/render/renderer.hpp"
#include "engine/world/driver_input.hpp"

namespace septet::screen {

struct DisplayOptions {
  std::uint32_t width_px = 0, height_px = 0;
  bool is_virtual = false;
  bool full_screen = false;
  std::optional<std::uint32_t> monitor;
  bool validation = false;
  std::string title;
};

class Display {
 public:
  static Expected<std::unique_ptr<Display>> open(const DisplayOptions& options);
  virtual ~Display() = default;

  virtual render::Renderer& renderer() = 0;
  struct Size {
    std::uint32_t width_px = 0, height_px = 0;
    bool operator==(const Size&) const = default;
  };
  /// Size of the window; empty for an off-screen display, and while a window has no area.
  virtual std::optional<Size> window_size() const = 0;
  /// Handles the window system's events: often enough that keys are read while a picture is drawn in another thread.
  virtual void attend() = 0;
  /// Request of the person to leave or pause, by its cause: a key once per press. `poll_leaving` handles the window
  /// system's events, too.
  enum class Leaving : std::uint8_t { no, closed, escape, restart, enter };
  virtual Leaving poll_leaving() = 0;
  /// Driver input from keyboard or gamepad, for a rig whose car is one; empty before they are touched, and for an
  /// off-screen display.
  virtual std::optional<DriverInput> controls(double now_s, double speed_mps) = 0;
  /// True if keyboard or gamepad have been touched since the display opened.
  virtual bool is_touched() const = 0;
  /// True if the person has requested the table of keys (F1) since the last call.
  virtual bool take_keys_request() = 0;
  /// True if presenting waits for the display's refresh.
  virtual bool paces_itself() const = 0;
};

/// Opens a display in a window or over a whole monitor (window_display.cpp); needs a window system.
Expected<std::unique_ptr<Display>> open_window(const DisplayOptions& options, render::RendererOptions renderer_options);

}  // namespace septet::screen
