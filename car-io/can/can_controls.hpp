#pragma once
/// The car's controls from a CAN bus, as a device that sends Septet's own input reports (REPORTS.md): whoever reads a HID device reads it.
///
/// The reports' sequence moves when every message with the wheel or a pedal has come since it moved last, so that one node that falls
/// silent makes the car stale. Values that are no numbers, and selectors and gears that there are not, keep what was there before.

#include "car-io/can/can_bus.hpp"
#include "car-io/can/can_plan.hpp"
#include "car-io/hid_device.hpp"
#include "engine/world/driver_input.hpp"

namespace septet::car_io {

DriverInput driver_input_of(const CanControls& controls, const DriverInput& before);

/// Opens the bus and reads the plan's heard messages. `steering_lock_rad` is what the reports' full steering means.
OpenHidDevice can_controls_opener(OpenCanBus open, CanPlan plan, double steering_lock_rad);

}  // namespace septet::car_io
