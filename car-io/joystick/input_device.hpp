#pragma once
/// An input device of Linux (evdev): any wheel, joystick or set of pedals with a kernel driver, behind an interface
/// that tests implement.
///
/// Threads: one at a time. Errors: an unplugged device returns an Error from every call; close it and open it again.

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>

#include "car-io/joystick/wheel_effects.hpp"
#include "engine/core/expected.hpp"

namespace septet::car_io {

struct InputAxis {
  std::int32_t value = 0, low = 0, high = 0;
};

/// Present state: axes by their ABS_ number, pressed buttons by their BTN_ number.
struct InputState {
  std::map<std::uint16_t, InputAxis> axes;
  std::set<std::uint16_t> down;
};

class InputDevice {
 public:
  virtual ~InputDevice() = default;
  /// Takes the events since the last call. Never waits.
  virtual Expected<const InputState*> read() = 0;
  /// Turns the wheel: −1 (right) to 1 (left) of its motor's maximum, for 250 ms unless renewed: the driver's own
  /// watchdog, for a program that hangs. Returns false if it has no constant force.
  virtual Expected<bool> set_force(double force) = 0;
  /// The wheel's own effects while `set_force` goes on. Returns false if it has none of them.
  virtual Expected<bool> set_feel(const WheelFeel& /*feel*/) { return false; }
};

struct InputAddress {
  std::uint16_t vendor_id = 0, product_id = 0;
  std::string serial;  ///< Empty: any.
};
Expected<std::unique_ptr<InputDevice>> open_input_device(const InputAddress& address,
                                                         const std::filesystem::path& sys = "/sys",
                                                         const std::filesystem::path& dev = "/dev");

}  // namespace septet::car_io
