#pragma once
/// A device through libusb: the second way to a HID device, for where its hidraw node may not be opened, and the only one to a device that is
/// no HID device and speaks by an interrupt or bulk endpoint in each direction.
///
/// A transfer is a report of REPORTS.md, its id in byte 0. Feature reports are HID's requests GET_REPORT and SET_REPORT (HID 1.11, 7.2); a
/// device that is no HID device answers the same as requests of its vendor. Where no OUT endpoint is there, outputs go as SET_REPORT, too.
///
/// While it is open the kernel's own driver lets go of the interface (no hidraw, no evdev), which belongs to one program alone: all that one
/// opener opens share it, whatever thread they are on. An unplugged device returns an Error from every call; opening looks for it anew.

#include <cstdint>
#include <optional>

#include "car-io/hid_device.hpp"
#include "engine/rig/rig.hpp"

namespace septet::car_io {

/// The HID interface of the device, or the one that the rig names.
OpenHidDevice usb_opener(const HidAddress& address, const std::optional<rig::UsbEndpoints>& endpoints);

/// The rig's car by the way that it names: hidraw, libusb, or whichever opens first.
OpenHidDevice hid_opener(const rig::Car& car);

}  // namespace septet::car_io
