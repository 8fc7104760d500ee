// hidapi's own path through libusb, beside Septet's: used by other programs for this car.

#include <dlfcn.h>
#include <hidapi/hidapi.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>

#include <doctest/doctest.h>

#include "car-io/car_layout.hpp"
#include "car-io/car_report.hpp"
#include "tests/rig-vm/guest.hpp"
#include "tests/rig-vm/usb_car.hpp"

namespace septet::rig_vm {
namespace {

using namespace car_io;

/// The library by its file: its names are those of the one that car-io is linked with.
class HidapiLibusb {
 public:
  HidapiLibusb() : library_(dlopen("/bin/libhidapi-libusb.so", RTLD_NOW | RTLD_LOCAL | RTLD_DEEPBIND), &dlclose) {
    REQUIRE_MESSAGE(library_ != nullptr, dlerror());
    REQUIRE(get<decltype(hid_init)>("hid_init")() == 0);
  }
  ~HidapiLibusb() { CHECK(get<decltype(hid_exit)>("hid_exit")() == 0); }
  HidapiLibusb(const HidapiLibusb&) = delete;
  HidapiLibusb& operator=(const HidapiLibusb&) = delete;

  template <class Function>
  Function* get(const char* name) const {
    void* found = dlsym(library_.get(), name);
    REQUIRE_MESSAGE(found != nullptr, name);
    return reinterpret_cast<Function*>(found);
  }

 private:
  std::unique_ptr<void, int (*)(void*)> library_;
};

}  // namespace

TEST_SUITE_BEGIN("usb");

TEST_CASE("hidapi through libusb reads the car and moves it and reads its watchdog") {
  UsbCar car(UsbCar::Kind::hid);
  car.plug();
  DriverInput input;
  input.accelerator = 0.75;
  car.set(input);
  hid_device* device = nullptr;
  const HidapiLibusb hidapi;
  // Without udev it sees what is there when it begins; opening races with the kernel's own driver. (By serial number it
  // would need iconv's tables.)
  REQUIRE(becomes_true(
      [&] {
        sleep_s(0.05);
        hidapi.get<decltype(hid_exit)>("hid_exit")();
        hidapi.get<decltype(hid_init)>("hid_init")();
        device = hidapi.get<decltype(hid_open)>("hid_open")(0x1209, 0x0001, nullptr);
        return device != nullptr;
      },
      5.0));
  std::array<unsigned char, 64> report{};
  const auto read = hidapi.get<decltype(hid_read_timeout)>("hid_read_timeout");
  CHECK(becomes_true([&] {
    const int count = read(device, report.data(), report.size(), 100);
    if (count <= 0) return false;
    const auto bytes = std::as_bytes(std::span(report)).first(static_cast<std::size_t>(count));
    const auto decoded = decode_report(car_layouts().front(), {}, bytes);
    return decoded && decoded->accelerator > 0.7499 && decoded->accelerator < 0.7501;
  }));
  const auto fan = encode_actuators({.fan = 0.5}, 1);
  const auto write = hidapi.get<decltype(hid_write)>("hid_write");
  CHECK(write(device, reinterpret_cast<const unsigned char*>(fan.data()), fan.size()) == static_cast<int>(fan.size()));
  CHECK(becomes_true([&] { return car.actuators().fan > 0.49; }));
  const auto feature = encode_device_status({.watchdog_ms = 300});
  CHECK(hidapi.get<decltype(hid_send_feature_report)>("hid_send_feature_report")(
            device, reinterpret_cast<const unsigned char*>(feature.data()), feature.size()) ==
        static_cast<int>(feature.size()));
  report = {device_report_id};
  CHECK(hidapi.get<decltype(hid_get_feature_report)>("hid_get_feature_report")(
            device, report.data(), device_report_bytes) == static_cast<int>(device_report_bytes));
  CHECK(decode_device_status(std::as_bytes(std::span(report)).first(device_report_bytes)).value().watchdog_ms == 300);
  const double since_s = now_s();
  car.unplug();
  CHECK(becomes_true([&] { return read(device, report.data(), report.size(), 100) < 0; }));
  measured("pulled out to an error of reading, hidapi-libusb", 1000.0 * (now_s() - since_s), "ms");
  CHECK(now_s() - since_s < 0.2);
  hidapi.get<decltype(hid_close)>("hid_close")(device);
}

TEST_SUITE_END();

}  // namespace septet::rig_vm
