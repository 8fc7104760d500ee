#pragma once
/// The driver's car as the first stage of a tick: driver input → vehicle, on the ground under its wheels and among what stands
/// beside the road.

#include <vector>

#include "engine/simulation/state.hpp"

namespace septet::simulation {

/// The car as it stands in this tick, worked out once and taken along through the stages.
struct DrivenCar {
  vehicle::VehicleOutputs outputs;
  Participant participant;
};

/// One tick of the car: eight steps of the vehicle and of what its body touches; returns where that leaves it. Events are appended.
DrivenCar advance_car(const Model& model, State& state, std::vector<Event>& events);

/// The car as everybody else sees it.
DrivenCar driven_car(const Model& model, const State& state);

/// What pushed the car in this tick, after its own step: `impulse_ns` in the world frame, at its mass centre.
void push_car(const Model& model, const Vec3& impulse_ns, State& state, DrivenCar& car);

/// The instruments and measures of the driver's car, for the snapshot.
DriverCar driver_car(const Model& model, const State& state, const vehicle::VehicleOutputs& outputs);

}  // namespace septet::simulation
