#pragma once
/// The driver's controls in one tick, in physical units, independent of the device.

#include <cstdint>

#include "engine/math/rigid_transform.hpp"

namespace septet {

enum class IndicatorStalk : std::int8_t { right = -1, off = 0, left = 1 };
/// Selector of an automatic gearbox; `manual` means that `DriverInput::gear` counts.
enum class GearSelector : std::uint8_t { park, reverse, neutral, drive, manual };

/// Position of the driver's eyes, and the turn of the pictures around them. At rest all is 0.
struct Head {
  Vec3 from_rest_m{0.0};  ///< From the rig's eye point, along the car's axes.
  double turn_rad =
      /// Turn of the pictures around the eyes, to the left: a driver who looks aside by a key has one screen to look
      /// at.
      0.0;
  bool operator==(const Head&) const = default;
};
/// Limit of any head movement; rigs set narrower ones.
inline constexpr double farthest_head_m = 1.0;

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
  /// Heading of the driver's head, from the head tracker, the keys or the simulated driver; positive to the left.
  double gaze_heading_rad = 0.0;
  std::uint8_t sequence = 0;  ///< Counts the device's reports; a constant value means a stale device.
  Head head;

  bool operator==(const DriverInput&) const = default;
};

}  // namespace septet
