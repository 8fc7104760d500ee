#pragma once
/// The car's side of its reports, which in a car is the firmware's: the descriptor, and what the host asks of fan and shaker.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "car-io/car_report.hpp"
#include "car-io/firmware/septet_firmware.h"
#include "engine/core/bytes.hpp"

namespace septet::car_io {

/// The firmware's report descriptor (HID 1.11, 6.2.2).
inline std::span<const std::uint8_t> car_report_descriptor() {
  return {septet_report_descriptor, septet_report_descriptor_bytes};
}

/// Fan and vibration of an output report; empty if it is another one.
inline std::optional<Actuators> decode_actuators(std::span<const std::byte> report) {
  ByteReader in(report);
  if (report.size() != actuators_report_bytes || in.get<std::uint8_t>() != actuators_report_id) return std::nullopt;
  Actuators actuators;
  actuators.fan = in.get<std::uint16_t>() / 65535.0;
  actuators.vibration = in.get<std::uint16_t>() / 65535.0;
  actuators.vibration_hz = in.get<std::uint8_t>();
  return actuators;
}

}  // namespace septet::car_io
