#pragma once
/// Motion of the car as the driver feels it, from the simulation's state.

#include "car-io/actuators.hpp"
#include "engine/simulation/state.hpp"

namespace septet::server {

car_io::CarMotion car_motion(const simulation::Model& model, const simulation::State& state);

}  // namespace septet::server
