#include "car-io/car_layout.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/core.h>

namespace septet::car_io {
namespace {

using enum CarButton;

constexpr std::uint8_t septet_buttons = 9 * 8;
constexpr std::array septet_car_buttons{
    ButtonField{indicator_left, septet_buttons + 0}, ButtonField{indicator_right, septet_buttons + 1},
    ButtonField{hazard_lights, septet_buttons + 2},  ButtonField{horn, septet_buttons + 3},
    ButtonField{low_beam, septet_buttons + 4},       ButtonField{high_beam, septet_buttons + 5},
    ButtonField{parking_brake, septet_buttons + 6},  ButtonField{emergency_stop, septet_buttons + 7},
    ButtonField{rearm, septet_buttons + 8}};

// Button n of the G29, in Linux' order, is bit 4 + n.
constexpr std::array g29_buttons{
    ButtonField{horn, 4 + 0},           ButtonField{high_beam, 4 + 3},    ButtonField{indicator_right, 4 + 6},
    ButtonField{indicator_left, 4 + 7}, ButtonField{gear_1, 4 + 12},      ButtonField{gear_2, 4 + 13},
    ButtonField{gear_3, 4 + 14},        ButtonField{gear_4, 4 + 15},      ButtonField{gear_5, 4 + 16},
    ButtonField{gear_6, 4 + 17},        ButtonField{gear_reverse, 4 + 18}};

const std::array layouts{
    CarLayout{.name = "septet-car",
              .report_id = controls_report_id,
              .report_bytes = controls_report_bytes,
              .may_be_longer = false,
              .steering = {1, 16, true, 0.0, -32767.0},
              .accelerator = {3, 16, false, 0.0, 65535.0},
              .brake = {5, 16, false, 0.0, 65535.0},
              .clutch = {7, 16, false, 0.0, 65535.0},
              .selector_byte = 11,
              .head_byte = 12,
              .sequence_byte = 14,
              .buttons = septet_car_buttons,
              .has_actuators = true},
    CarLayout{.name = "logitech-g29",
              .report_id = std::nullopt,
              .report_bytes = 9,
              .may_be_longer = true,
              .steering = {4, 16, false, 32767.5, 0.0},
              .accelerator = {6, 8, false, 255.0, 0.0},
              .brake = {7, 8, false, 255.0, 0.0},
              .clutch = {8, 8, false, 255.0, 0.0},
              .selector_byte = std::nullopt,
              .head_byte = std::nullopt,
              .sequence_byte = std::nullopt,
              .buttons = g29_buttons},
};

tl::unexpected<Error> refused(const CarLayout& layout, std::string what) {
  return failure(std::move(what), fmt::format("report of the car, layout {}", layout.name),
                 "check the rig's [car] layout and the device's firmware (car-io/REPORTS.md)");
}

/// The report's length was checked against the layout, and every field lies within it.
std::uint8_t byte_at(std::span<const std::byte> report, std::size_t index) {
  return static_cast<std::uint8_t>(report[index]);
}

std::int16_t signed_at(std::span<const std::byte> report, std::size_t index) {
  return static_cast<std::int16_t>(byte_at(report, index) | byte_at(report, index + 1) << 8);
}

double read_axis(const AxisField& field, std::span<const std::byte> report) {
  double raw = byte_at(report, field.byte);
  if (field.bits == 16)
    raw = field.is_signed ? signed_at(report, field.byte) : static_cast<std::uint16_t>(signed_at(report, field.byte));
  return (raw - field.at_zero) / (field.at_one - field.at_zero);
}

/// Travel beyond the dead zone, 0 to 1.
double beyond(double travel, double dead_zone) {
  return std::clamp((travel - dead_zone) / (1.0 - dead_zone), 0.0, 1.0);
}

/// 0 released to 1 floored.
double calibrated_pedal(const rig::AxisCalibration& axis, double reading) {
  const double travel = std::clamp((reading - axis.min) / (axis.max - axis.min), 0.0, 1.0);
  return beyond(axis.inverted ? 1.0 - travel : travel, axis.dead_zone);
}

/// −1 full right to 1 full left.
double calibrated_wheel(const rig::AxisCalibration& axis, double reading) {
  const double from_centre = reading - axis.centre;
  const double travel = std::abs(from_centre) / (from_centre < 0.0 ? axis.centre - axis.min : axis.max - axis.centre);
  const double side = (from_centre < 0.0) != axis.inverted ? -1.0 : 1.0;
  return side * beyond(travel, axis.dead_zone);
}

bool is_pressed(const CarLayout& layout, CarButton button, std::span<const std::byte> report) {
  const auto found = std::ranges::find(layout.buttons, button, &ButtonField::button);
  return found != layout.buttons.end() && (byte_at(report, found->bit / 8) >> (found->bit % 8) & 1) != 0;
}

/// The gear lever of the layout's buttons: reverse, 1 to 6, or neutral between them.
std::int8_t read_gear_lever(const CarLayout& layout, std::span<const std::byte> report) {
  if (is_pressed(layout, gear_reverse, report)) return -1;
  for (int gear = 1; gear <= 6; ++gear)
    if (is_pressed(layout, static_cast<CarButton>(static_cast<int>(gear_1) + gear - 1), report))
      return static_cast<std::int8_t>(gear);
  return 0;
}

}  // namespace

bool CarLayout::has(CarButton button) const {
  return std::ranges::find(buttons, button, &ButtonField::button) != buttons.end();
}

std::span<const CarLayout> car_layouts() { return layouts; }

Expected<const CarLayout*> find_car_layout(std::string_view name) {
  std::string known;
  for (const CarLayout& layout : layouts) {
    if (layout.name == name) return &layout;
    known += (known.empty() ? "" : ", ") + std::string(layout.name);
  }
  return failure(fmt::format("there is no report layout '{}'", name), "rig, [car] layout", "use one of: " + known);
}

Expected<AxisReadings> read_axes(const CarLayout& layout, std::span<const std::byte> report) {
  const bool fits = layout.may_be_longer ? report.size() >= layout.report_bytes : report.size() == layout.report_bytes;
  if (!fits) return refused(layout, fmt::format("it has {} bytes where {} belong", report.size(), layout.report_bytes));
  if (layout.report_id && byte_at(report, 0) != *layout.report_id)
    return refused(layout, fmt::format("it has id {} where {} belongs", byte_at(report, 0), *layout.report_id));
  return AxisReadings{
      .steering = read_axis(layout.steering, report),
      .accelerator = read_axis(layout.accelerator, report),
      .brake = read_axis(layout.brake, report),
      .clutch = read_axis(layout.clutch, report),
  };
}

CarSwitches read_switches(const CarLayout& layout, std::span<const std::byte> report) {
  return {is_pressed(layout, emergency_stop, report), is_pressed(layout, rearm, report)};
}

void press(const CarLayout& layout, CarButton button, std::span<std::byte> report) {
  const auto found = std::ranges::find(layout.buttons, button, &ButtonField::button);
  if (found != layout.buttons.end() && found->bit / 8u < report.size())
    report[found->bit / 8u] |= static_cast<std::byte>(1u << found->bit % 8u);
}

Expected<DriverInput> decode_report(const CarLayout& layout, const rig::CarCalibration& calibration,
                                    std::span<const std::byte> report) {
  const auto axes = read_axes(layout, report);
  if (!axes) return tl::unexpected(axes.error());
  DriverInput input;
  if (layout.selector_byte) {
    const std::uint8_t value = byte_at(report, *layout.selector_byte);
    const int selector = value & 0xf, gear = (value >> 4) - 1;
    if (selector > static_cast<int>(GearSelector::manual) || gear > 6)
      return refused(layout, fmt::format("its selector is {} and its gear {}", selector, gear));
    input.selector = static_cast<GearSelector>(selector);
    input.gear = static_cast<std::int8_t>(gear);
  } else if (calibration.gear_lever) {
    input.selector = GearSelector::manual;
    input.gear = read_gear_lever(layout, report);
  }
  input.steering_wheel_rad = calibration.steering_lock_rad * calibrated_wheel(calibration.steering, axes->steering);
  input.accelerator = calibrated_pedal(calibration.accelerator, axes->accelerator);
  input.brake = calibrated_pedal(calibration.brake, axes->brake);
  input.clutch = calibrated_pedal(calibration.clutch, axes->clutch);
  const bool left = is_pressed(layout, indicator_left, report), right = is_pressed(layout, indicator_right, report);
  if (left != right) input.indicator = left ? IndicatorStalk::left : IndicatorStalk::right;
  input.hazard_lights = is_pressed(layout, hazard_lights, report);
  input.horn = is_pressed(layout, horn, report);
  // A wheel without a light switch drives with its lights on.
  input.low_beam = !layout.has(low_beam) || is_pressed(layout, low_beam, report);
  input.high_beam = is_pressed(layout, high_beam, report);
  input.parking_brake = is_pressed(layout, parking_brake, report);
  if (layout.head_byte)
    if (const std::int16_t head = signed_at(report, *layout.head_byte); head != -32768)
      input.gaze_heading_rad = -head / 32767.0 * std::numbers::pi;
  if (layout.sequence_byte) input.sequence = byte_at(report, *layout.sequence_byte);
  return input;
}

}  // namespace septet::car_io
