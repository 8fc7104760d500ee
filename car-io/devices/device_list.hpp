#pragma once
/// What is connected to this machine that a rig may use: HID devices, wheels and joysticks, USB devices, CAN interfaces, sound cards.
///
/// Of a wheel it is said by which of the two its motor would be moved, evdev or HID PID through hidraw, as car-io/joystick does it.
/// Read from /sys alone: nothing is opened, so that nothing is disturbed; /dev is asked whether it may be. Names come from the devices and are
/// made printable. What disappears while it is read is left out.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace septet::car_io {

enum class DeviceKind : std::uint8_t { hid, joystick, usb, can, sound };

struct FoundDevice {
  DeviceKind kind = DeviceKind::hid;
  std::string node;  ///< "/dev/hidraw0", or "can0".
  std::string name;
  std::uint16_t vendor_id = 0, product_id = 0;  ///< 0 where it has none.
  std::string serial;
  std::string detail;         ///< "force by evdev: constant, spring", "down", "CAN FD".
  bool may_be_opened = true;  ///< By this user.
  std::string remedy;         ///< What to do where it may not, or is down; a line each.
  /// Of a wheel whose force the kernel's driver does not know: the hidraw node that its motor is moved through (car-io/pid).
  std::string motor_node;
};

/// `sys` and `dev`: "/sys" and "/dev", or those of a test. Sorted by kind and node.
std::vector<FoundDevice> list_devices(const std::filesystem::path& sys, const std::filesystem::path& dev);

/// Of the device's vendor and product, for a file below /etc/udev/rules.d with a number under 73.
std::string udev_rule(const FoundDevice& device);

/// A table for people, with a remedy below each device that has one.
std::string device_table(const std::vector<FoundDevice>& devices);

}  // namespace septet::car_io
