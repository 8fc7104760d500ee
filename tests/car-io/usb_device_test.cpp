// Tests that need a device are in tests/rig-vm.
#include "car-io/usb_device.hpp"

#include <optional>
#include <string>

#include <doctest/doctest.h>

#include "engine/rig/rig.hpp"

namespace septet::car_io {

TEST_CASE("a car that is not there is named whatever the way to it") {
  const auto where = [](rig::HidAccess access, std::optional<rig::UsbEndpoints> usb) {
    rig::Car car;
    car.product_id = 0xfffe;  // The one of the vendor that no device has.
    car.access = access;
    car.usb = usb;
    const OpenHidDevice open = hid_opener(car);
    CHECK_FALSE(open().has_value());
    const auto again = open();
    return again ? std::string() : again.error().where;
  };
  CHECK(where(rig::HidAccess::automatic, std::nullopt) == "HID device 1209:fffe");
  CHECK(where(rig::HidAccess::hidraw, std::nullopt) == "HID device 1209:fffe");
  CHECK(where(rig::HidAccess::libusb, std::nullopt) == "USB device 1209:fffe");
  CHECK(where(rig::HidAccess::automatic, rig::UsbEndpoints{}) == "USB device 1209:fffe");
}

}  // namespace septet::car_io
