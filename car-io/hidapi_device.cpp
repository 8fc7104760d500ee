#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include <fmt/core.h>
#include <fmt/xchar.h>
#include <hidapi/hidapi.h>

#include "car-io/hid_device.hpp"

namespace septet::car_io {
namespace {

constexpr std::size_t largest_report = 4096;  // HIDRAW's HID_MAX_BUFFER_SIZE in kernels up to 6.
constexpr int most_waiting_reports = 256;     // The kernel keeps 63; more at once is a flood.

std::string narrow(const wchar_t* text) {
  std::string result;
  for (; text && *text; ++text) result += *text < 128 ? static_cast<char>(*text) : '?';
  return result.empty() ? "no reason given" : result;
}

std::string name_of(const HidAddress& address) {
  return fmt::format("HID device {:04x}:{:04x}{}", address.vendor_id, address.product_id,
                     address.serial.empty() ? "" : " serial " + address.serial);
}

class HidapiDevice final : public HidDevice {
 public:
  HidapiDevice(hid_device* device, std::string name) : device_(device), name_(std::move(name)) {}

  Expected<std::optional<Bytes>> read_newest() override {
    std::optional<Bytes> newest;
    for (int i = 0; i < most_waiting_reports; ++i) {
      const int count = hid_read_timeout(device_.get(), buffer_.data(), buffer_.size(), 0);
      if (count < 0) return lost("reading");
      if (count == 0) break;
      const auto bytes = std::as_bytes(std::span(buffer_).first(static_cast<std::size_t>(count)));
      newest.emplace(bytes.begin(), bytes.end());
    }
    return newest;
  }

  Expected<void> write(std::span<const std::byte> report) override {
    if (hid_write(device_.get(), reinterpret_cast<const unsigned char*>(report.data()), report.size()) < 0)
      return lost("writing");
    return {};
  }

  Expected<Bytes> get_feature(std::uint8_t id, std::size_t size) override {
    Bytes report(std::max<std::size_t>(size, 1));
    report[0] = static_cast<std::byte>(id);
    const int count =
        hid_get_feature_report(device_.get(), reinterpret_cast<unsigned char*>(report.data()), report.size());
    if (count < 0) return lost(fmt::format("reading feature report {}", id));
    report.resize(static_cast<std::size_t>(count));
    return report;
  }

  Expected<void> send_feature(std::span<const std::byte> report) override {
    if (hid_send_feature_report(device_.get(), reinterpret_cast<const unsigned char*>(report.data()), report.size()) <
        0)
      return lost("sending a feature report");
    return {};
  }

 private:
  struct Close {
    void operator()(hid_device* device) const { hid_close(device); }
  };
  tl::unexpected<Error> lost(const std::string& doing) const {
    return failure(fmt::format("{} failed: {}", doing, narrow(hid_error(device_.get()))), name_,
                   "check the cable; it is opened again by itself");
  }

  std::unique_ptr<hid_device, Close> device_;
  std::string name_;
  std::array<unsigned char, largest_report> buffer_{};
};

}  // namespace

namespace {

/// hidapi keeps the last error of opening in one place for all threads.
std::mutex& opening() {
  static std::mutex mutex;
  return mutex;
}

Expected<std::unique_ptr<HidDevice>> open_path(const std::string& path, const std::string& name) {
  hid_device* device = hid_open_path(path.c_str());
  if (!device)
    return failure(fmt::format("{} cannot be opened: {}", path, narrow(hid_error(nullptr))), name,
                   "give your user access with a udev rule (car-io/README.md)");
  return std::make_unique<HidapiDevice>(device, name);
}

}  // namespace

Expected<std::unique_ptr<HidDevice>> open_hid_node(const std::string& node) {
  const std::lock_guard lock(opening());
  return open_path(node, "HID device " + node);
}

Expected<std::unique_ptr<HidDevice>> open_hid_device(const HidAddress& address) {
  const std::lock_guard lock(opening());
  const std::string name = name_of(address);
  hid_device_info* devices = hid_enumerate(address.vendor_id, address.product_id);
  std::string path;
  for (const hid_device_info* device = devices; device; device = device->next)
    if (address.serial.empty() || (device->serial_number && narrow(device->serial_number) == address.serial)) {
      path = device->path;
      break;
    }
  const bool another_serial = devices != nullptr && path.empty();
  hid_free_enumeration(devices);
  if (path.empty())
    return failure(another_serial ? "a device of this kind is plugged in, but with another serial number"
                                  : "the device is not plugged in",
                   name, "check the cable and the rig's [car] table (vendor_id, product_id, serial)");
  return open_path(path, name);
}

}  // namespace septet::car_io
