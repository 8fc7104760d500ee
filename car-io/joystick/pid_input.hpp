#pragma once
/// A wheel whose motor the kernel's driver does not know: evdev says what the driver does, HID PID reports move it (car-io/pid).

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "car-io/hid_device.hpp"
#include "car-io/joystick/input_device.hpp"
#include "car-io/pid/pid_reports.hpp"

namespace septet::car_io {

struct PidNode {
  std::string node;  ///< "/dev/hidraw0".
  PidReports reports;
};
/// Of the HID device that an input device ("event5") belongs to; nothing where it has no force of this class.
std::optional<PidNode> find_pid_node(const std::string& event, const std::filesystem::path& sys,
                                     const std::filesystem::path& dev);

std::unique_ptr<InputDevice> with_pid_force(std::unique_ptr<InputDevice> input, std::unique_ptr<HidDevice> motor,
                                            const PidReports& reports);

}  // namespace septet::car_io
