#include "tests/rig-vm/usb_car.hpp"

#include <fcntl.h>
#include <linux/usb/functionfs.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include <doctest/doctest.h>

#include "tests/car-io/car_side.hpp"
#include "tests/rig-vm/guest.hpp"

namespace septet::rig_vm {
namespace {

using namespace car_io;

const std::string gadget = "/sys/kernel/config/usb_gadget/car";
const std::string endpoints = "/dev/car";

using Blob = std::vector<std::uint8_t>;

void add16(Blob& blob, unsigned value) {
  blob.insert(blob.end(), {static_cast<std::uint8_t>(value), static_cast<std::uint8_t>(value >> 8)});
}
void add32(Blob& blob, unsigned value) {
  add16(blob, value & 0xFFFFu);
  add16(blob, value >> 16);
}

/// Interface, HID descriptor, an endpoint in each direction (USB 2.0, 9.6; HID 1.11, 6.2.1), as FunctionFS wants them
/// for both speeds.
Blob descriptors(UsbCar::Kind kind) {
  const bool is_hid = kind == UsbCar::Kind::hid;
  Blob body;
  const unsigned each = is_hid ? 4 : 3;
  add32(body, each);
  add32(body, each);
  for (const bool is_high_speed : {false, true}) {
    body.insert(body.end(), {9, 4, 0, 0, 2, static_cast<std::uint8_t>(is_hid ? 3 : 0xFF), 0, 0, 0});
    if (is_hid) {
      body.insert(body.end(), {9, 0x21, 0x11, 0x01, 0, 1, 0x22});
      add16(body, static_cast<unsigned>(car_report_descriptor().size()));
    }
    const std::uint8_t type = is_hid ? 3 : 2, every_ms = is_hid ? (is_high_speed ? 4 : 1) : 0;
    const unsigned packet = !is_hid && is_high_speed ? 512 : 64;
    for (const std::uint8_t address : {0x81, 0x02}) {
      body.insert(body.end(), {7, 5, address, type});
      add16(body, packet);
      body.push_back(every_ms);
    }
  }
  Blob blob;
  add32(blob, FUNCTIONFS_DESCRIPTORS_MAGIC_V2);
  add32(blob, static_cast<unsigned>(body.size() + 12));
  add32(blob, FUNCTIONFS_HAS_FS_DESC | FUNCTIONFS_HAS_HS_DESC);
  blob.insert(blob.end(), body.begin(), body.end());
  return blob;
}

void write_all(int file, const Blob& blob) {
  REQUIRE(write(file, blob.data(), blob.size()) == static_cast<ssize_t>(blob.size()));
}

}  // namespace

struct UsbCar::Request {
  usb_ctrlrequest setup;
};

UsbCar::UsbCar(Kind kind, const std::string& serial) : kind_(kind) {
  command(
      "mkdir " + gadget + " && cd " + gadget +
      " && echo 0x1209 >idVendor && echo 1 >idProduct && mkdir strings/0x409 configs/c.1 functions/ffs.car && echo " +
      serial +
      " >strings/0x409/serialnumber && echo 'Septet car' >strings/0x409/product && ln -s functions/ffs.car "
      "configs/c.1");
  command("mkdir -p " + endpoints + " && mount -t functionfs car " + endpoints);
  control_ = open((endpoints + "/ep0").c_str(), O_RDWR);
  REQUIRE(control_ >= 0);
  write_all(control_, descriptors(kind));
  Blob strings;
  for (const unsigned word : {unsigned{FUNCTIONFS_STRINGS_MAGIC}, 16u, 0u, 0u}) add32(strings, word);
  write_all(control_, strings);
  // Without waiting for a host; while there is one they wait for it.
  in_ = open((endpoints + "/ep1").c_str(), O_RDWR | O_NONBLOCK);
  out_ = open((endpoints + "/ep2").c_str(), O_RDWR | O_NONBLOCK);
  REQUIRE((in_ >= 0 && out_ >= 0));
  threads_.emplace_back([this] { answer_requests(); });
  threads_.emplace_back([this] { take_outputs(); });
  threads_.emplace_back([this] { send_inputs(); });
}

UsbCar::~UsbCar() {
  is_ending_ = true;
  unplug();
  for (std::thread& thread : threads_) thread.join();
  for (const int file : {in_, out_, control_}) close(file);
  last_command("umount " + endpoints + " && cd " + gadget +
               " && rm configs/c.1/ffs.car && rmdir functions/ffs.car configs/c.1 strings/0x409 && cd .. && rmdir car");
}

void UsbCar::plug() {
  if (!std::exchange(is_plugged_, true)) command("echo dummy_udc.0 >" + gadget + "/UDC");
}

void UsbCar::unplug() {
  if (std::exchange(is_plugged_, false)) last_command("echo '' >" + gadget + "/UDC");
}

void UsbCar::set(const DriverInput& input, const CarSwitches& switches) {
  const std::lock_guard lock(mutex_);
  switches_ = switches;
  input_ = input;
}

Actuators UsbCar::actuators() {
  const std::lock_guard lock(mutex_);
  return now_s() - output_at_s_ > status_.watchdog_ms / 1000.0 ? Actuators{} : actuators_;
}

std::uint16_t UsbCar::watchdog_ms() {
  const std::lock_guard lock(mutex_);
  return status_.watchdog_ms;
}

std::uint64_t UsbCar::outputs() {
  const std::lock_guard lock(mutex_);
  return outputs_;
}

void UsbCar::take(std::span<const std::byte> report) {
  const std::lock_guard lock(mutex_);
  if (const auto status = decode_device_status(report)) {
    status_.watchdog_ms = status->watchdog_ms;
    return;
  }
  const auto actuators = decode_actuators(report);
  const auto steering = decode_steering(report);
  if (actuators)
    actuators_ = {actuators->fan, actuators->vibration, actuators->vibration_hz, actuators_.steering};
  else if (steering)
    actuators_.steering = *steering;
  else
    return;
  output_at_s_ = now_s();
  ++outputs_;
}

void UsbCar::answer(const Request& request) {
  const usb_ctrlrequest& setup = request.setup;
  const bool in = (setup.bRequestType & USB_DIR_IN) != 0;
  const unsigned kind = setup.bRequestType & USB_TYPE_MASK, type = setup.wValue >> 8, id = setup.wValue & 0xFFu;
  const bool is_report = kind == (kind_ == Kind::hid ? USB_TYPE_CLASS : USB_TYPE_VENDOR);
  if (in && kind == USB_TYPE_STANDARD && setup.bRequest == USB_REQ_GET_DESCRIPTOR && type == 0x22) {
    const auto descriptor = car_report_descriptor();
    [[maybe_unused]] const ssize_t sent =
        write(control_, descriptor.data(), std::min<std::size_t>(descriptor.size(), setup.wLength));
  } else if (in && is_report && setup.bRequest == 0x01 && type == 3 && id == device_report_id) {
    std::unique_lock lock(mutex_);
    const auto report = encode_device_status(status_);
    lock.unlock();
    [[maybe_unused]] const ssize_t sent =
        write(control_, report.data(), std::min<std::size_t>(report.size(), setup.wLength));
  } else if (!in && is_report && setup.bRequest == 0x09) {
    std::array<std::byte, 64> report{};
    const ssize_t count = read(control_, report.data(), std::min<std::size_t>(report.size(), setup.wLength));
    if (count > 0) take(std::span(report).first(static_cast<std::size_t>(count)));
  } else if (!in && kind == USB_TYPE_CLASS) {
    [[maybe_unused]] const ssize_t acknowledged = read(control_, nullptr, 0);  // SET_IDLE.
  } else {
    // The wrong direction is how FunctionFS refuses.
    [[maybe_unused]] const ssize_t refused = in ? read(control_, nullptr, 0) : write(control_, nullptr, 0);
  }
}

void UsbCar::answer_requests() {
  while (!is_ending_) {
    pollfd waiting{control_, POLLIN, 0};
    if (poll(&waiting, 1, 20) <= 0) continue;
    usb_functionfs_event event{};
    if (read(control_, &event, sizeof event) == static_cast<ssize_t>(sizeof event) && event.type == FUNCTIONFS_SETUP)
      answer({event.u.setup});
  }
}

void UsbCar::take_outputs() {
  while (!is_ending_) {
    std::array<std::byte, 512> report{};
    const ssize_t count = is_hanging_ ? -1 : read(out_, report.data(), report.size());
    if (count > 0)
      take(std::span(report).first(static_cast<std::size_t>(count)));
    else
      sleep_s(0.002);
  }
}

void UsbCar::send_inputs() {
  for (std::uint8_t sequence = 0; !is_ending_; sleep_s(0.008)) {
    std::unique_lock lock(mutex_);
    input_.sequence = ++sequence;
    const auto report = encode_controls(input_, default_steering_lock_rad, switches_);
    lock.unlock();
    // Waits until the host has asked for it.
    [[maybe_unused]] const ssize_t sent = write(in_, report.data(), report.size());
  }
}

}  // namespace septet::rig_vm
