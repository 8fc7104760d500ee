#pragma once
/// Values of the instruments at a tick. A pure function.

#include "car-io/actuators.hpp"
#include "car-io/can/can_plan.hpp"
#include "engine/world/driver_input.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::car_io {

/// The engine is warm and the tank 60 % full: neither is simulated.
Instruments instruments_of(const Snapshot& snapshot, const DriverInput& input, const CarMotion& motion,
                           bool has_lost_controls);

}  // namespace septet::car_io
