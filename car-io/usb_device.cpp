#include "car-io/usb_device.hpp"

#include <sys/time.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <libusb-1.0/libusb.h>

namespace septet::car_io {
namespace {

constexpr std::size_t reading_at_once = 8;  // Reports pending before the device must wait.
constexpr unsigned timeout_ms = 250;        // Timeout of a write or request: the device's own watchdog.
constexpr std::size_t largest_transfer = 1024;

/// The interface of the device and how to speak with it.
struct UsbWay {
  int interface = 0;
  std::uint8_t in = 0, out = 0;  ///< Endpoints; no `out`: SET_REPORT.
  bool in_is_bulk = false, out_is_bulk = false;
  std::size_t in_bytes = 64;
  bool is_hid = true;
};

std::string reason(int code) { return libusb_strerror(static_cast<libusb_error>(code)); }

bool is_endpoint_of(const libusb_endpoint_descriptor& endpoint, bool in) {
  const int type = endpoint.bmAttributes & LIBUSB_TRANSFER_TYPE_MASK;
  return ((endpoint.bEndpointAddress & LIBUSB_ENDPOINT_IN) != 0) == in &&
         (type == LIBUSB_TRANSFER_TYPE_INTERRUPT || type == LIBUSB_TRANSFER_TYPE_BULK);
}

/// The named endpoints, or those of the first HID interface; empty without them.
std::optional<UsbWay> find_way(const libusb_config_descriptor& config, const std::optional<rig::UsbEndpoints>& named) {
  for (int i = 0; i < config.bNumInterfaces; ++i) {
    if (config.interface[i].num_altsetting < 1) continue;
    const libusb_interface_descriptor& interface = config.interface[i].altsetting[0];
    UsbWay way{.interface = interface.bInterfaceNumber, .is_hid = interface.bInterfaceClass == LIBUSB_CLASS_HID};
    if (named ? interface.bInterfaceNumber != named->interface : !way.is_hid) continue;
    for (int e = 0; e < interface.bNumEndpoints; ++e) {
      const libusb_endpoint_descriptor& endpoint = interface.endpoint[e];
      const bool is_bulk = (endpoint.bmAttributes & LIBUSB_TRANSFER_TYPE_MASK) == LIBUSB_TRANSFER_TYPE_BULK;
      const std::uint8_t address = endpoint.bEndpointAddress;
      if (way.in == 0 && is_endpoint_of(endpoint, true) && (!named || named->in == address)) {
        way.in = address;
        way.in_is_bulk = is_bulk;
        way.in_bytes = std::clamp<std::size_t>(endpoint.wMaxPacketSize & 0x7FFu, 1, largest_transfer);
      } else if (way.out == 0 && is_endpoint_of(endpoint, false) && (!named || named->out == address)) {
        way.out = address;
        way.out_is_bulk = is_bulk;
      }
    }
    const bool has_all = way.in != 0 && (!named || named->out == 0 || way.out != 0);
    if (has_all) return way;
  }
  return std::nullopt;
}

/// An open device with its interface claimed, and the transfers that read it.
class UsbLink {
 public:
  static Expected<std::shared_ptr<UsbLink>> open(const HidAddress& address,
                                                 const std::optional<rig::UsbEndpoints>& endpoints,
                                                 const std::string& name) {
    auto link = std::shared_ptr<UsbLink>(new UsbLink(name));
    // A new context sees the devices plugged in now, also where udev does not notify an old one (containers).
    if (const int code = libusb_init(&link->context_); code != 0)
      return failure("libusb cannot start: " + reason(code), name, "check that /dev/bus/usb is there");
    libusb_device** devices = nullptr;
    const auto count = libusb_get_device_list(link->context_, &devices);
    auto opened =
        link->open_one(std::span(devices, static_cast<std::size_t>(std::max<ssize_t>(count, 0))), address, endpoints);
    if (devices) libusb_free_device_list(devices, 1);
    if (!opened) return tl::unexpected(std::move(opened.error()));
    return link;
  }

  UsbLink(const UsbLink&) = delete;
  UsbLink& operator=(const UsbLink&) = delete;
  ~UsbLink() {
    stop_reading();
    if (handle_) {
      libusb_release_interface(handle_, way_.interface);
      libusb_close(handle_);
    }
    if (context_) libusb_exit(context_);
  }

  bool is_lost() {
    const std::lock_guard lock(mutex_);
    return loss_ != 0;
  }

  /// The newest report after the one with this number, which is updated.
  Expected<std::optional<Bytes>> read_newer_than(std::uint64_t& number) {
    if (auto begun = start_reading(); !begun) return tl::unexpected(std::move(begun.error()));
    timeval none{};
    libusb_handle_events_timeout_completed(context_, &none, nullptr);
    const std::lock_guard lock(mutex_);
    if (loss_ != 0) return lost("reading", loss_);
    if (number_ == number) return std::nullopt;
    number = number_;
    return newest_;
  }

  Expected<void> write(std::span<const std::byte> report) {
    const bool has_no_id = way_.is_hid && !report.empty() && report[0] == std::byte{0};
    if (way_.out == 0) return request(false, 2, report).map([](const Bytes&) {});
    // hidapi's convention: a device without ids is written to with an id of 0, which is not transmitted.
    Bytes bytes(report.begin() + (has_no_id ? 1 : 0), report.end());
    int sent = 0;
    const auto transfer = way_.out_is_bulk ? libusb_bulk_transfer : libusb_interrupt_transfer;
    const int code = transfer(handle_, way_.out, reinterpret_cast<unsigned char*>(bytes.data()),
                              static_cast<int>(bytes.size()), &sent, timeout_ms);
    if (code != 0) return lose("writing", code);
    return {};
  }

  /// HID's GET_REPORT or SET_REPORT of an output (2) or feature (3) report.
  Expected<Bytes> request(bool get, unsigned type, std::span<const std::byte> report) {
    Bytes bytes(report.begin(), report.end());
    const unsigned kind = static_cast<unsigned>(way_.is_hid ? LIBUSB_REQUEST_TYPE_CLASS : LIBUSB_REQUEST_TYPE_VENDOR) |
                          LIBUSB_RECIPIENT_INTERFACE | (get ? LIBUSB_ENDPOINT_IN : LIBUSB_ENDPOINT_OUT);
    const unsigned id = bytes.empty() ? 0u : std::to_integer<unsigned>(bytes[0]);
    const int count = libusb_control_transfer(
        handle_, static_cast<std::uint8_t>(kind), get ? 0x01 : 0x09, static_cast<std::uint16_t>(type << 8 | id),
        static_cast<std::uint16_t>(way_.interface), reinterpret_cast<unsigned char*>(bytes.data()),
        static_cast<std::uint16_t>(bytes.size()), timeout_ms);
    if (count < 0) return lose(get ? "reading a feature report" : "sending a report", count);
    bytes.resize(std::min(bytes.size(), static_cast<std::size_t>(count)));
    return bytes;
  }

 private:
  explicit UsbLink(std::string name) : name_(std::move(name)) {}

  Expected<void> open_one(std::span<libusb_device* const> devices, const HidAddress& address,
                          const std::optional<rig::UsbEndpoints>& endpoints) {
    bool is_another = false;
    for (libusb_device* device : devices) {
      libusb_device_descriptor said{};
      if (libusb_get_device_descriptor(device, &said) != 0 || said.idVendor != address.vendor_id ||
          said.idProduct != address.product_id)
        continue;
      if (const int code = libusb_open(device, &handle_); code != 0)
        return failure("libusb cannot open it: " + reason(code), name_,
                       "give your user access with a udev rule (septet devices prints it)");
      if (!address.serial.empty() && serial_of(said.iSerialNumber) != address.serial) {
        is_another = true;
        libusb_close(std::exchange(handle_, nullptr));
        continue;
      }
      return claim(device, endpoints);
    }
    return failure(is_another ? "a device of this kind is plugged in, but with another serial number"
                              : "the device is not plugged in",
                   name_, "check the cable and the rig's [car] table (vendor_id, product_id, serial)");
  }

  std::string serial_of(std::uint8_t index) {
    std::array<unsigned char, 256> text{};
    const int count =
        index == 0 ? 0 : libusb_get_string_descriptor_ascii(handle_, index, text.data(), static_cast<int>(text.size()));
    return {reinterpret_cast<const char*>(text.data()), static_cast<std::size_t>(std::max(count, 0))};
  }

  Expected<void> claim(libusb_device* device, const std::optional<rig::UsbEndpoints>& endpoints) {
    libusb_config_descriptor* config = nullptr;
    if (const int code = libusb_get_active_config_descriptor(device, &config); code != 0)
      return close_after(failure("it has no configuration: " + reason(code), name_, "plug it in again"));
    const auto way = find_way(*config, endpoints);
    libusb_free_config_descriptor(config);
    if (!way)
      return close_after(failure(
          endpoints ? fmt::format("it has no interface {} with the endpoints 0x{:02x} and 0x{:02x}",
                                  endpoints->interface, endpoints->in, endpoints->out)
                    : "it is no HID device",
          name_, "name its interface and interrupt or bulk endpoints in the rig's [car.usb] (lsusb -v shows them)"));
    way_ = *way;
    libusb_set_auto_detach_kernel_driver(handle_, 1);
    if (const int code = libusb_claim_interface(handle_, way_.interface); code != 0)
      return close_after(failure(fmt::format("its interface {} is not to be had: {}", way_.interface, reason(code)),
                                 name_, "end the other program that has it"));
    return {};
  }
  tl::unexpected<Error> close_after(tl::unexpected<Error> error) {
    libusb_close(std::exchange(handle_, nullptr));
    return error;
  }

  Expected<void> start_reading() {
    const std::lock_guard lock(mutex_);
    if (is_reading_ || loss_ != 0) return {};
    is_reading_ = true;
    for (Reading& reading : readings_) {
      reading.link = this;
      reading.buffer.resize(way_.in_bytes);
      reading.transfer = libusb_alloc_transfer(0);
      const auto fill = way_.in_is_bulk ? libusb_fill_bulk_transfer : libusb_fill_interrupt_transfer;
      if (reading.transfer)
        fill(reading.transfer, handle_, way_.in, reading.buffer.data(), static_cast<int>(reading.buffer.size()),
             &UsbLink::take, &reading, 0);
      submit(reading);
    }
    if (loss_ != 0) return lost("reading", loss_);
    return {};
  }

  void stop_reading() {
    {
      const std::lock_guard lock(mutex_);
      is_ending_ = true;
      for (Reading& reading : readings_)
        if (reading.is_submitted) libusb_cancel_transfer(reading.transfer);
    }
    const auto is_any_submitted = [&] {
      const std::lock_guard lock(mutex_);
      return std::ranges::any_of(readings_, &Reading::is_submitted);
    };
    while (is_any_submitted()) {
      timeval some{.tv_sec = 0, .tv_usec = 10'000};
      libusb_handle_events_timeout_completed(context_, &some, nullptr);
    }
    for (Reading& reading : readings_) libusb_free_transfer(reading.transfer);
  }

  struct Reading {
    UsbLink* link = nullptr;
    libusb_transfer* transfer = nullptr;
    std::vector<unsigned char> buffer;
    bool is_submitted = false;
  };

  void submit(Reading& reading) {
    const int code = reading.transfer ? libusb_submit_transfer(reading.transfer) : LIBUSB_ERROR_NO_MEM;
    reading.is_submitted = code == 0;
    if (code != 0) loss_ = code;
  }

  /// Called by libusb on the thread that handles its events.
  static void LIBUSB_CALL take(libusb_transfer* transfer) {
    Reading& reading = *static_cast<Reading*>(transfer->user_data);
    UsbLink& link = *reading.link;
    const std::lock_guard lock(link.mutex_);
    reading.is_submitted = false;
    if (transfer->status == LIBUSB_TRANSFER_COMPLETED) {
      const auto bytes = std::as_bytes(
          std::span(reading.buffer).first(static_cast<std::size_t>(std::max(transfer->actual_length, 0))));
      link.newest_.assign(bytes.begin(), bytes.end());
      if (!bytes.empty()) ++link.number_;
    } else if (transfer->status != LIBUSB_TRANSFER_CANCELLED) {
      link.loss_ = transfer->status == LIBUSB_TRANSFER_NO_DEVICE ? LIBUSB_ERROR_NO_DEVICE : LIBUSB_ERROR_IO;
    }
    if (!link.is_ending_ && link.loss_ == 0) link.submit(reading);
  }

  tl::unexpected<Error> lose(const std::string& doing, int code) {
    const std::lock_guard lock(mutex_);
    if (code == LIBUSB_ERROR_NO_DEVICE) loss_ = code;
    return lost(doing, code);
  }
  tl::unexpected<Error> lost(const std::string& doing, int code) const {
    return failure(fmt::format("{} failed: {}", doing, reason(code)), name_,
                   "check the cable; it is opened again by itself");
  }

  std::string name_;
  libusb_context* context_ = nullptr;
  libusb_device_handle* handle_ = nullptr;
  UsbWay way_;

  std::mutex mutex_;  ///< Guards the members below.
  std::array<Reading, reading_at_once> readings_;
  bool is_reading_ = false, is_ending_ = false;
  int loss_ = 0;  ///< libusb's code of the loss, after which reading is impossible.
  Bytes newest_;
  std::uint64_t number_ = 0;
};

class UsbDevice final : public HidDevice {
 public:
  explicit UsbDevice(std::shared_ptr<UsbLink> link) : link_(std::move(link)) {}

  Expected<std::optional<Bytes>> read_newest() override { return link_->read_newer_than(number_); }
  Expected<void> write(std::span<const std::byte> report) override { return link_->write(report); }
  Expected<Bytes> get_feature(std::uint8_t id, std::size_t size) override {
    Bytes report(std::max<std::size_t>(size, 1));
    report[0] = static_cast<std::byte>(id);
    return link_->request(true, 3, report);
  }
  Expected<void> send_feature(std::span<const std::byte> report) override {
    return link_->request(false, 3, report).map([](const Bytes&) {});
  }

 private:
  std::shared_ptr<UsbLink> link_;
  std::uint64_t number_ = 0;
};

/// Shared by all devices of one opener, while any of them is open.
struct SharedLink {
  std::mutex mutex;
  std::weak_ptr<UsbLink> link;
};

}  // namespace

OpenHidDevice usb_opener(const HidAddress& address, const std::optional<rig::UsbEndpoints>& endpoints) {
  const std::string name = fmt::format("USB device {:04x}:{:04x}{}", address.vendor_id, address.product_id,
                                       address.serial.empty() ? "" : " serial " + address.serial);
  return [address, endpoints, name, shared = std::make_shared<SharedLink>()]() -> Expected<std::unique_ptr<HidDevice>> {
    const std::lock_guard lock(shared->mutex);
    auto link = shared->link.lock();
    if (!link || link->is_lost()) {
      auto opened = UsbLink::open(address, endpoints, name);
      if (!opened) return tl::unexpected(std::move(opened.error()));
      link = std::move(*opened);
      shared->link = link;
    }
    return std::make_unique<UsbDevice>(std::move(link));
  };
}

OpenHidDevice hid_opener(const rig::Car& car) {
  const HidAddress address{car.vendor_id, car.product_id, car.serial};
  auto by_usb = usb_opener(address, car.usb);
  if (car.usb || car.access == rig::HidAccess::libusb) return by_usb;
  if (car.access == rig::HidAccess::hidraw) return [address] { return open_hid_device(address); };
  return [address, by_usb = std::move(by_usb)]() -> Expected<std::unique_ptr<HidDevice>> {
    auto device = open_hid_device(address);
    if (device) return device;
    auto second = by_usb();
    if (second) return second;
    return device;
  };
}

}  // namespace septet::car_io
