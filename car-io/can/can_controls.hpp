#pragma once
/// The car's controls from a CAN bus, as a device that sends Septet's own input reports (REPORTS.md): any reader of a
/// HID device reads it.
///
/// The reports' sequence advances once every message with the wheel or a pedal has come since its last advance, so that
/// one silent node makes the car stale. NaN and infinite values, and undefined selectors and gears, keep the previous
/// value.

#include "car-io/can/can_bus.hpp"
#include "car-io/can/can_plan.hpp"
#include "car-io/hid_device.hpp"
#include "engine/world/driver_input.hpp"

namespace septet::car_io {

DriverInput driver_input_of(const CanControls& controls, const DriverInput& before);

/// Opens the bus and reads the plan's heard messages. `steering_lock_rad` is the angle of the reports' full steering.
OpenHidDevice can_controls_opener(OpenCanBus open, CanPlan plan, double steering_lock_rad);

}  // namespace septet::car_io
