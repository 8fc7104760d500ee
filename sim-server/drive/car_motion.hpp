#pragma once
/// What the driver can feel of the car, from the simulation's state.

#include "car-io/actuators.hpp"
#include "engine/simulation/state.hpp"

namespace septet::server {

car_io::CarMotion car_motion(const simulation::Model& model, const simulation::State& state);

}  // namespace septet::server
