#pragma once
/// A device through libusb: the second path to a HID device, if its hidraw node may not be opened, and the only one to
/// a device that is not HID and has an interrupt or bulk endpoint in each direction.
///
/// A transfer is a report of REPORTS.md, its id in byte 0. Feature reports are HID's requests GET_REPORT and SET_REPORT
/// (HID 1.11, 7.2); a device that is not HID takes the same as vendor requests. Without an OUT endpoint, outputs go as
/// SET_REPORT, too.
///
/// While it is open the kernel's own driver releases the interface (no hidraw, no evdev), which belongs to one program
/// alone: all devices of one opener share it, on any thread. An unplugged device returns an Error from every call;
/// opening searches for it again.

#include <cstdint>
#include <optional>

#include "car-io/hid_device.hpp"
#include "engine/rig/rig.hpp"

namespace septet::car_io {

/// The HID interface of the device, or the one that the rig names.
OpenHidDevice usb_opener(const HidAddress& address, const std::optional<rig::UsbEndpoints>& endpoints);

/// The rig's car by its configured path: hidraw, libusb, or the first that opens.
OpenHidDevice hid_opener(const rig::Car& car);

}  // namespace septet::car_io
