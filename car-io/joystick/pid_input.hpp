#pragma once
/// A wheel whose motor the kernel's driver does not know: evdev says what the driver does, HID PID reports move it (car-io/pid).

#include <memory>

#include "car-io/hid_device.hpp"
#include "car-io/joystick/input_device.hpp"
#include "car-io/pid/pid_reports.hpp"

namespace septet::car_io {

std::unique_ptr<InputDevice> with_pid_force(std::unique_ptr<InputDevice> input, std::unique_ptr<HidDevice> motor,
                                            const PidReports& reports);

}  // namespace septet::car_io
