#pragma once
/// The HID reports of Septet's own car, as REPORTS.md specifies them: descriptor, and values to bytes.

#include <array>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>

#include "engine/core/bytes.hpp"
#include "engine/core/expected.hpp"
#include "engine/world/driver_input.hpp"

namespace septet::car_io {

inline constexpr std::uint8_t controls_report_id = 1, actuators_report_id = 2, device_report_id = 3,
                              steering_report_id = 4;
inline constexpr std::size_t controls_report_bytes = 15, actuators_report_bytes = 7, device_report_bytes = 5,
                             steering_report_bytes = 4;

/// Full left or right of a hand wheel with 2½ turns from lock to lock.
inline constexpr double default_steering_lock_rad = 2.5 * std::numbers::pi;

/// The car's own safety switches, beside the driver's controls.
struct CarSwitches {
  /// The contact of the emergency stop, which has cut the power of fan and amplifier itself.
  bool emergency_stop = false;
  bool rearm = false;  ///< The button that lets fan, shaker and wheel force run again, while it is held.
  bool operator==(const CarSwitches&) const = default;
};

/// Input report of these controls; values beyond a field's range are clamped. The caller keeps the sequence.
std::array<std::byte, controls_report_bytes> encode_controls(const DriverInput& input,
                                                             double steering_lock_rad = default_steering_lock_rad,
                                                             const CarSwitches& switches = {});

/// Commands of the car's actuators, 0 to 1.
struct Actuators {
  double fan = 0.0;
  double vibration = 0.0;
  double vibration_hz = 0.0;
  double steering = 0.0;  ///< Force of the hand wheel's motor, −1 to 1 (turns it to the left).
};
std::array<std::byte, actuators_report_bytes> encode_actuators(const Actuators& actuators, std::uint8_t sequence);

std::array<std::byte, steering_report_bytes> encode_steering(double force, std::uint8_t sequence);
Expected<double> decode_steering(std::span<const std::byte> report);

struct DeviceStatus {
  std::uint16_t firmware = 0;
  std::uint16_t watchdog_ms = 250;
};
std::array<std::byte, device_report_bytes> encode_device_status(const DeviceStatus& status);
Expected<DeviceStatus> decode_device_status(std::span<const std::byte> report);

}  // namespace septet::car_io
