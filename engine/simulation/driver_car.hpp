#pragma once
/// The driver's car as the first stage of a tick: driver input → vehicle, on the ground under its wheels and among the
/// obstacles beside the road.

#include <vector>

#include "engine/simulation/state.hpp"

namespace septet::simulation {

/// The car as it stands in this tick, computed once and passed through the stages.
struct DrivenCar {
  vehicle::VehicleOutputs outputs;
  Participant participant;
};

/// Advances the car by one tick: eight steps of the vehicle and of its body's contacts; returns the result. Events are
/// appended.
DrivenCar advance_car(const Model& model, State& state, std::vector<Event>& events);

/// The car as other stages see it.
DrivenCar driven_car(const Model& model, const State& state);

/// Applies an impulse on the car in this tick, after its own step: `impulse_ns` in the world frame, at its mass centre.
void push_car(const Model& model, const Vec3& impulse_ns, State& state, DrivenCar& car);

/// The instruments and measures of the driver's car, for the snapshot.
DriverCar driver_car(const Model& model, const State& state, const vehicle::VehicleOutputs& outputs);

}  // namespace septet::simulation
