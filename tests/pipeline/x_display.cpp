#include "tests/pipeline/x_display.hpp"

#include <X11/Xlib.h>
#include <X11/keysym.h>

#include <cstring>
#include <memory>

#include "tests/pipeline/process_rig.hpp"

namespace septet::pipeline {
namespace {

program::ChildProcess start_server() {
  auto process =
      program::ChildProcess::start({.program = "/usr/bin/Xvfb",
                                    .arguments = {"-displayfd", "1", "-screen", "0", "640x480x24", "-nolisten", "tcp"},
                                    .environment = {},
                                    .log = "/dev/null"});
  REQUIRE(process.has_value());
  return std::move(*process);
}

struct Close {
  void operator()(Display* display) const { XCloseDisplay(display); }
};
using Connection = std::unique_ptr<Display, Close>;

Connection connect(const std::string& name) {
  Connection display(XOpenDisplay(name.c_str()));
  REQUIRE(display != nullptr);
  return display;
}

/// 0 where there is none.
Window find_window(Display* display, const std::string& title) {
  Window root = 0, parent = 0, *children = nullptr, found = 0;
  unsigned count = 0;
  XQueryTree(display, DefaultRootWindow(display), &root, &parent, &children, &count);
  for (unsigned i = 0; i < count; ++i) {
    char* name = nullptr;
    if (XFetchName(display, children[i], &name) == 0) continue;
    if (title == name) found = children[i];
    XFree(name);
  }
  if (children) XFree(children);
  return found;
}

}  // namespace

XDisplay::XDisplay() : server_(start_server()) {
  const auto number = server_.read_line(patience);
  REQUIRE(number.has_value());
  name_ = ":" + *number;
}

bool XDisplay::has_window(const std::string& title) const {
  const auto display = connect(name_);
  return find_window(display.get(), title) != 0;
}

void XDisplay::close_window(const std::string& title) const {
  const auto display = connect(name_);
  XEvent event{};
  event.xclient.type = ClientMessage;
  event.xclient.window = find_window(display.get(), title);
  REQUIRE(event.xclient.window != 0);
  event.xclient.message_type = XInternAtom(display.get(), "WM_PROTOCOLS", False);
  event.xclient.format = 32;
  event.xclient.data.l[0] = static_cast<long>(XInternAtom(display.get(), "WM_DELETE_WINDOW", False));
  XSendEvent(display.get(), event.xclient.window, False, NoEventMask, &event);
  XSync(display.get(), False);
}

void XDisplay::send_key(const std::string& title, unsigned long key, bool pressed) const {
  const auto display = connect(name_);
  XEvent event{};
  event.xkey.type = pressed ? KeyPress : KeyRelease;
  event.xkey.display = display.get();
  event.xkey.window = find_window(display.get(), title);
  REQUIRE(event.xkey.window != 0);
  event.xkey.root = DefaultRootWindow(display.get());
  event.xkey.same_screen = True;
  event.xkey.time = 1;
  event.xkey.keycode = XKeysymToKeycode(display.get(), key);
  XSendEvent(display.get(), event.xkey.window, False, pressed ? KeyPressMask : KeyReleaseMask, &event);
  XSync(display.get(), False);
}

void XDisplay::press_escape(const std::string& title) const { send_key(title, XK_Escape, true); }

void XDisplay::press_enter(const std::string& title) const { send_key(title, XK_Return, true); }

void XDisplay::press_r(const std::string& title) const { send_key(title, XK_r, true); }

void XDisplay::tap_arrow_up(const std::string& title) const {
  send_key(title, XK_Up, true);
  send_key(title, XK_Up, false);
}

std::array<int, 4> XDisplay::place_of(const std::string& title) const {
  const auto display = connect(name_);
  XWindowAttributes attributes{};
  XGetWindowAttributes(display.get(), find_window(display.get(), title), &attributes);
  return {attributes.x, attributes.y, attributes.width, attributes.height};
}

}  // namespace septet::pipeline
