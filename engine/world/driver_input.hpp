#pragma once
/// What the driver does with the controls in one tick, in physical units, whatever device it came from.

#include <cstdint>

namespace septet {

enum class IndicatorStalk : std::int8_t { right = -1, off = 0, left = 1 };
/// Selector of an automatic gearbox; `manual` means that `DriverInput::gear` counts.
enum class GearSelector : std::uint8_t { park, reverse, neutral, drive, manual };

struct DriverInput {
  double steering_wheel_rad = 0.0;  ///< Hand-wheel angle, positive to the left, lock at about ±7.85 (2½ turns in all).
  double accelerator = 0.0;         ///< 0 (released) to 1 (floored); likewise the two below.
  double brake = 0.0;
  double clutch = 0.0;
  GearSelector selector = GearSelector::drive;
  std::int8_t gear = 0;  ///< −1 reverse, 0 neutral, 1…6, with the selector in `manual`.
  IndicatorStalk indicator = IndicatorStalk::off;
  bool hazard_lights = false;
  bool horn = false;
  bool low_beam = true;
  bool high_beam = false;
  bool parking_brake = false;
  /// Where the driver's head points, from the eye tracker or the simulated driver; positive to the left.
  double gaze_heading_rad = 0.0;
  std::uint8_t sequence = 0;  ///< Counts the device's reports; standing still means a stale device.

  bool operator==(const DriverInput&) const = default;
};

}  // namespace septet
