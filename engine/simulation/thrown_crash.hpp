#pragma once
/// A vehicle meets somebody who is thrown by it, or lies there: what others are told of it.

#include <vector>

#include "engine/physics/person/vehicle_solid.hpp"
#include "engine/simulation/state.hpp"

namespace septet::simulation {

/// A vehicle and somebody on foot or on two wheels, as they are at the touch.
struct ThrownTouch {
  Participant vehicle, other;
  person::Touches touches;
};

/// Logs the touch, of the driver's car as `collision`, else as `crash_of_others`; begins its record; tells the effects.
void tell_touch(const Model& model, const ThrownTouch& touch, State& state, std::vector<Event>& events);

/// Adds to the record what the vehicle has lost in this tick to the body of `other`.
void record_loss(ParticipantId vehicle, ParticipantId other, const Vec3& on_vehicle_ns, State& state);

}  // namespace septet::simulation
