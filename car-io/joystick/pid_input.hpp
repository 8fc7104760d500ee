#pragma once
/// A wheel whose motor is unknown to the kernel's driver: controls from evdev, force by HID PID reports (car-io/pid).

#include <memory>

#include "car-io/hid_device.hpp"
#include "car-io/joystick/input_device.hpp"
#include "car-io/pid/pid_reports.hpp"

namespace septet::car_io {

std::unique_ptr<InputDevice> with_pid_force(std::unique_ptr<InputDevice> input, std::unique_ptr<HidDevice> motor,
                                            const PidReports& reports);

}  // namespace septet::car_io
