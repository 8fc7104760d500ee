#include "car-io/driving_keys.hpp"

#include <fmt/format.h>

namespace septet::car_io {

std::span<const DrivingKey> driving_keys() {
  static constexpr std::array keys{
      DrivingKey{{Key::arrow_up, Key::w}, &KeyStates::accelerate, "accelerate"},
      DrivingKey{{Key::arrow_down, Key::s}, &KeyStates::brake, "brake; pressed anew at a standstill: drive backwards"},
      DrivingKey{{Key::arrow_left, Key::a}, &KeyStates::left, "steer to the left"},
      DrivingKey{{Key::arrow_right, Key::d}, &KeyStates::right, "steer to the right"},
      DrivingKey{{Key::space, Key::space}, &KeyStates::parking_brake, "parking brake, while held"},
      DrivingKey{{Key::p, Key::p}, &KeyStates::set_parking_brake, "parking brake, set and released"},
      DrivingKey{{Key::m, Key::m}, &KeyStates::manual, "at a standstill: gears by hand, and back to automatic"},
      DrivingKey{{Key::v, Key::v}, &KeyStates::clutch, "clutch, while held; it starts a stalled engine"},
      DrivingKey{{Key::g, Key::g}, &KeyStates::gear_up, "by hand: next gear up (reverse, neutral, first, ...)"},
      DrivingKey{{Key::b, Key::b}, &KeyStates::gear_down, "by hand: next gear down"},
      DrivingKey{{Key::comma, Key::comma}, &KeyStates::indicator_left, "left indicator, on and off"},
      DrivingKey{{Key::full_stop, Key::full_stop}, &KeyStates::indicator_right, "right indicator, on and off"},
      DrivingKey{{Key::x, Key::x}, &KeyStates::hazard_lights, "hazard lights, on and off"},
      DrivingKey{{Key::l, Key::l}, &KeyStates::low_beam, "low beam, on and off"},
      DrivingKey{{Key::f, Key::f}, &KeyStates::high_beam, "high beam, while held"},
      DrivingKey{{Key::h, Key::h}, &KeyStates::horn, "horn, while held"},
      DrivingKey{{Key::q, Key::q}, &KeyStates::look_left, "look to the left, while held"},
      DrivingKey{{Key::e, Key::e}, &KeyStates::look_right, "look to the right, while held"},
      DrivingKey{{Key::f1, Key::f1}, nullptr, "show these keys, or hide them"},
      DrivingKey{{Key::escape, Key::escape}, nullptr, "pause, and go on; before the drive has begun: leave"},
      DrivingKey{{Key::r, Key::r}, nullptr, "begin the drive again, while it is paused"},
      DrivingKey{{Key::enter, Key::enter}, nullptr, "end the drive, while it is paused"},
  };
  return keys;
}

KeyStates key_states(const std::function<bool(Key)>& is_down) {
  KeyStates states;
  for (const DrivingKey& key : driving_keys()) {
    if (!key.held) continue;  // Handled by the window, which must find a short press itself.
    // Both are queried, since a window forgets a short press only when queried for it.
    const bool first = is_down(key.keys[0]), second = is_down(key.keys[1]);
    states.*key.held = first || second;
  }
  return states;
}

std::string names_of_keys(const DrivingKey& key) {
  std::string names(name_of(key.keys[0]));
  if (key.keys[1] != key.keys[0]) names += fmt::format(", {}", name_of(key.keys[1]));
  return names;
}

std::string driving_keys_text() {
  std::string text = "Keys of the window that looks ahead:\n";
  for (const DrivingKey& key : driving_keys()) text += fmt::format("  {:<16}{}\n", names_of_keys(key), key.does);
  return text + gamepad_text;
}

}  // namespace septet::car_io
