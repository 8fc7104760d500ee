#pragma once
/// What the driver can feel of the car, from the simulation's state.

#include "car-io/actuators.hpp"
#include "sim-server/simulation.hpp"

namespace septet::server {

car_io::CarMotion car_motion(const SimulationModel& model, const SimulationState& state);

}  // namespace septet::server
