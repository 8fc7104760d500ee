#include "car-io/car_report.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "car-io/driver_buttons.hpp"

namespace septet::car_io {
namespace {

std::uint16_t to_u16(double fraction) {
  return std::isfinite(fraction) ? static_cast<std::uint16_t>(std::lround(std::clamp(fraction, 0.0, 1.0) * 65535.0))
                                 : 0;
}
std::int16_t to_i16(double fraction) {
  return std::isfinite(fraction) ? static_cast<std::int16_t>(std::lround(std::clamp(fraction, -1.0, 1.0) * 32767.0))
                                 : 0;
}

template <std::size_t size>
std::array<std::byte, size> as_array(const Bytes& bytes) {
  std::array<std::byte, size> report{};
  std::ranges::copy(bytes, report.begin());
  return report;
}

tl::unexpected<Error> refused(std::span<const std::byte> report, std::uint8_t id, std::size_t size) {
  return failure(fmt::format("a report of {} bytes with id {} came where {} bytes with id {} belong", report.size(),
                             report.empty() ? 0 : static_cast<int>(report[0]), size, id),
                 "car", "check the firmware against car-io/REPORTS.md");
}

}  // namespace

std::array<std::byte, controls_report_bytes> encode_controls(const DriverInput& input, double steering_lock_rad,
                                                             const CarSwitches& switches) {
  Bytes bytes;
  ByteWriter out(bytes);
  out.put(controls_report_id);
  out.put(to_i16(-input.steering_wheel_rad / steering_lock_rad));
  for (const double pedal : {input.accelerator, input.brake, input.clutch}) out.put(to_u16(pedal));
  std::uint16_t bits = 0;
  unsigned bit = 0;
  const auto add = [&](bool is_pressed) { bits = static_cast<std::uint16_t>(bits | (is_pressed ? 1u : 0u) << bit++); };
  for (const bool is_pressed : driver_buttons(input)) add(is_pressed);
  for (const bool is_pressed : {switches.emergency_stop, switches.rearm}) add(is_pressed);
  out.put(bits);
  out.put(static_cast<std::uint8_t>(static_cast<int>(input.selector) | (std::clamp<int>(input.gear, -1, 6) + 1) << 4));
  out.put(to_i16(-input.gaze_heading_rad / std::numbers::pi));
  out.put(input.sequence);
  return as_array<controls_report_bytes>(bytes);
}

std::array<std::byte, actuators_report_bytes> encode_actuators(const Actuators& actuators, std::uint8_t sequence) {
  Bytes bytes;
  ByteWriter out(bytes);
  out.put(actuators_report_id);
  out.put(to_u16(actuators.fan));
  out.put(to_u16(actuators.vibration));
  out.put(static_cast<std::uint8_t>(
      std::isfinite(actuators.vibration_hz) ? std::clamp(actuators.vibration_hz, 0.0, 255.0) : 0.0));
  out.put(sequence);
  return as_array<actuators_report_bytes>(bytes);
}

std::array<std::byte, steering_report_bytes> encode_steering(double force, std::uint8_t sequence) {
  Bytes bytes;
  ByteWriter out(bytes);
  out.put(steering_report_id);
  out.put(to_i16(-force));  // Sign of the input report's hand wheel: negative is to the left.
  out.put(sequence);
  return as_array<steering_report_bytes>(bytes);
}

Expected<double> decode_steering(std::span<const std::byte> report) {
  ByteReader in(report);
  if (report.size() != steering_report_bytes || in.get<std::uint8_t>() != steering_report_id)
    return refused(report, steering_report_id, steering_report_bytes);
  return -in.get<std::int16_t>() / 32767.0;
}

std::array<std::byte, device_report_bytes> encode_device_status(const DeviceStatus& status) {
  Bytes bytes;
  ByteWriter out(bytes);
  out.put(device_report_id);
  out.put(status.firmware);
  out.put(status.watchdog_ms);
  return as_array<device_report_bytes>(bytes);
}

Expected<DeviceStatus> decode_device_status(std::span<const std::byte> report) {
  ByteReader in(report);
  if (report.size() != device_report_bytes || in.get<std::uint8_t>() != device_report_id)
    return refused(report, device_report_id, device_report_bytes);
  DeviceStatus status;
  status.firmware = in.get<std::uint16_t>();
  status.watchdog_ms = in.get<std::uint16_t>();
  return status;
}

}  // namespace septet::car_io
