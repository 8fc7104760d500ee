#pragma once
/// The engaged gear, and its changes.

#include "engine/physics/vehicle/vehicle_parameters.hpp"
#include "engine/physics/vehicle/vehicle_state.hpp"
#include "engine/world/driver_input.hpp"

namespace septet::vehicle {

/// Advances a shift in progress, or begins one. `pedal` is the accelerator; `output_radps` the speed of the gearbox's
/// output. A direction against the car's motion engages neutral.
void advance_gear(const PowertrainParameters& powertrain, const DriverInput& input, double pedal, double output_radps,
                  bool reverse_allowed, bool forward_allowed, double dt_s, PowertrainState& state);

/// −1, 0 or 1 for a car without gears.
int direct_gear(const DriverInput& input);

}  // namespace septet::vehicle
