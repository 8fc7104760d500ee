#pragma once
/// Connected devices that a rig may use: HID devices, wheels and joysticks, USB devices, CAN interfaces, sound cards.
///
/// For a wheel the list names the path to its motor, evdev or HID PID through hidraw, as car-io/joystick chooses it.
/// Read from /sys alone: nothing is opened, so that nothing is disturbed; /dev is queried for permissions. Names come
/// from the devices and are made printable. Devices that vanish during the reading are left out.

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
  std::uint16_t vendor_id = 0, product_id = 0;  ///< 0 without one.
  std::string serial;
  std::string detail;         ///< "force by evdev: constant, spring", "down", "CAN FD".
  bool may_be_opened = true;  ///< By this user.
  std::string remedy;         ///< Remedy for a device that is closed to the user, or down; a line each.
  /// For a wheel without force in the kernel's driver: the hidraw node for its motor (car-io/pid).
  std::string motor_node;
};

/// `sys` and `dev`: "/sys" and "/dev", or those of a test. Sorted by kind and node.
std::vector<FoundDevice> list_devices(const std::filesystem::path& sys, const std::filesystem::path& dev);

/// For the device's vendor and product, for a file below /etc/udev/rules.d with a number under 73.
std::string udev_rule(const FoundDevice& device);

/// A table for people, with a remedy below each device that has one.
std::string device_table(const std::vector<FoundDevice>& devices);

}  // namespace septet::car_io
