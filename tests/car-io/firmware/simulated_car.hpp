#pragma once
/// The firmware's core as a HID device on the host, in place of a microcontroller's port, on a clock of the test's own.

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>

#include "car-io/firmware/septet_firmware.h"
#include "car-io/hid_device.hpp"

namespace septet::car_io {

/// The car; any number of devices may be opened on it, as on a real one.
class SimulatedCar {
 public:
  SimulatedCar() {
    septet_start(&device);
    readings = {
        .steering = 0, .accelerator = 0, .brake = 0, .clutch = 0, .buttons = 0, .selector = 3, .gear = 1, .head = 0};
  }
  /// A millisecond at a time, as a port calls it; `ms` of them.
  void run(int ms) {
    const std::lock_guard lock(mutex);
    for (int i = 0; i < ms; ++i) septet_step(&device, &readings, ++now_ms, &outputs);
  }
  std::array<std::uint8_t, SEPTET_CONTROLS_BYTES> report() {
    const std::lock_guard lock(mutex);
    std::array<std::uint8_t, SEPTET_CONTROLS_BYTES> bytes{};
    septet_pack_controls(&device, bytes.data());
    return bytes;
  }
  bool take(std::span<const std::byte> report) {
    const std::lock_guard lock(mutex);
    return septet_take_report(&device, reinterpret_cast<const std::uint8_t*>(report.data()),
                              static_cast<std::uint32_t>(report.size()), now_ms);
  }
  auto state() {
    const std::lock_guard lock(mutex);
    return device.state;
  }
  bool is_off() {
    const std::lock_guard lock(mutex);
    return outputs.fan == 0 && outputs.vibration == 0 && outputs.steering == 0 && !outputs.fan_power &&
           !outputs.amplifier_power && !outputs.motor_power;
  }
  OpenHidDevice opener();

  std::mutex mutex;
  septet_device device{};
  septet_readings readings{};
  septet_outputs outputs{};
  std::uint32_t now_ms = 0xffffff00u;  ///< The clock wraps within the first second.
};

class SimulatedCarDevice final : public HidDevice {
 public:
  explicit SimulatedCarDevice(SimulatedCar& car) : car_(car) {}
  Expected<std::optional<Bytes>> read_newest() override {
    const auto report = std::as_bytes(std::span(newest_ = car_.report()));
    return Bytes(report.begin(), report.end());
  }
  Expected<void> write(std::span<const std::byte> report) override {
    if (!car_.take(report)) return failure("the firmware refuses a report", "simulated car", "see the test");
    return {};
  }
  Expected<Bytes> get_feature(std::uint8_t, std::size_t) override {
    const std::lock_guard lock(car_.mutex);
    std::array<std::uint8_t, SEPTET_DEVICE_BYTES> bytes{};
    septet_pack_device(&car_.device, bytes.data());
    const auto report = std::as_bytes(std::span(bytes));
    return Bytes(report.begin(), report.end());
  }
  Expected<void> send_feature(std::span<const std::byte> report) override { return write(report); }

 private:
  SimulatedCar& car_;
  std::array<std::uint8_t, SEPTET_CONTROLS_BYTES> newest_{};
};

inline OpenHidDevice SimulatedCar::opener() {
  return [this]() -> Expected<std::unique_ptr<HidDevice>> { return std::make_unique<SimulatedCarDevice>(*this); };
}

}  // namespace septet::car_io
