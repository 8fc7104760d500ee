#pragma once
/// A display without a monitor, for programs that open windows, and input that closes them.

#include <array>
#include <map>
#include <string>

#include "tests/pipeline/process_rig.hpp"

namespace septet::pipeline {

/// An Xvfb on a display number of its own choice; it ends with this object.
class XDisplay {
 public:
  XDisplay();
  std::map<std::string, std::string> environment() const { return {{"DISPLAY", name_}}; }
  /// True if there is a window of this title.
  bool has_window(const std::string& title) const;
  /// Left, top, width and height of the window, pixels of the display (640 × 480).
  std::array<int, 4> place_of(const std::string& title) const;
  /// Asks the window to close, as a window manager does for its owner.
  void close_window(const std::string& title) const;
  void press_escape(const std::string& title) const;
  void press_enter(const std::string& title) const;
  void press_r(const std::string& title) const;
  /// Presses and releases the arrow up.
  void tap_arrow_up(const std::string& title) const;

 private:
  void send_key(const std::string& title, unsigned long key, bool pressed) const;

  program::ChildProcess server_;
  std::string name_;
};

}  // namespace septet::pipeline
