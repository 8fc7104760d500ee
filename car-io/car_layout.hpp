#pragma once
/// Layout of a wheel's controls in its HID report, as data: one decoder for every wheel.
///
/// REPORTS.md lists the layouts. A report is untrusted: one that is too short, of another id or out of range is refused
/// with an Error.

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "car-io/car_report.hpp"
#include "engine/core/expected.hpp"
#include "engine/rig/rig.hpp"
#include "engine/world/driver_input.hpp"

namespace septet::car_io {

/// One axis of a report, little-endian, and the raw values of 0 and 1 (hand wheel: straight and full left; pedals:
/// released and floored).
struct AxisField {
  std::uint8_t byte = 0;
  std::uint8_t bits = 16;  ///< 8 or 16.
  bool is_signed = false;
  double at_zero = 0.0, at_one = 1.0;
};

enum class CarButton : std::uint8_t {
  indicator_left,
  indicator_right,
  hazard_lights,
  horn,
  low_beam,
  high_beam,
  parking_brake,
  gear_1,
  gear_2,
  gear_3,
  gear_4,
  gear_5,
  gear_6,
  gear_reverse,
  emergency_stop,
  rearm,
};

struct ButtonField {
  CarButton button = CarButton::horn;
  std::uint8_t bit = 0;  ///< From bit 0 of byte 0 on.
};

struct CarLayout {
  std::string_view name;
  std::optional<std::uint8_t> report_id;  ///< Empty: the device's reports have no id.
  std::size_t report_bytes = 0;
  bool may_be_longer = false;
  AxisField steering, accelerator, brake, clutch;
  std::optional<std::uint8_t> selector_byte, head_byte, sequence_byte;
  std::span<const ButtonField> buttons;
  bool has_actuators = false;  ///< Takes the output reports of REPORTS.md.

  bool has(CarButton button) const;
};

std::span<const CarLayout> car_layouts();
Expected<const CarLayout*> find_car_layout(std::string_view name);

/// Values of the axes in a layout's own scale, uncalibrated: hand wheel −1 (full right) to 1 (full left), pedals 0 to
/// 1. `septet-car calibrate` records them.
struct AxisReadings {
  double steering = 0.0, accelerator = 0.0, brake = 0.0, clutch = 0.0;
};
Expected<AxisReadings> read_axes(const CarLayout& layout, std::span<const std::byte> report);

/// From a report that `decode_report` has accepted; without switches in the layout all are released.
CarSwitches read_switches(const CarLayout& layout, std::span<const std::byte> report);

/// Sets this button in the report, if the layout has it.
void press(const CarLayout& layout, CarButton button, std::span<std::byte> report);

/// The calibration comes from the rig, which has checked it.
Expected<DriverInput> decode_report(const CarLayout& layout, const rig::CarCalibration& calibration,
                                    std::span<const std::byte> report);

}  // namespace septet::car_io
