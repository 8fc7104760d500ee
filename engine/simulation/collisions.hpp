#pragma once
/// Collisions of all participants: who meets whom, by the law of all impacts (engine/physics/impact).
///
/// Pairs with the driver's car, with one of the scenario, with a loose body or with somebody of traffic who errs are looked
/// at; two others of traffic are left to their engine. At the first touch at which the surfaces approach, either vehicle leaves its rails
/// (bodies/bodies.hpp), and their engagement is advanced each tick until they are apart. People and two-wheelers whom
/// a vehicle hits are thrown by a stage of their own (thrown_stage.hpp). Who cannot leave the rails stays on them:
/// the driver's car takes its share of the impulse (car_impacts.hpp), everybody else is only told.

#include <vector>

#include "engine/simulation/driver_car.hpp"
#include "engine/simulation/state.hpp"

namespace septet::simulation {

/// Finds those that overlap, as boxes with the corners of vehicles, and pushes the car and the bodies for this tick;
/// `car` and `participants` (ascending id) are then as they stand. A touch of the car that begins is counted and logged
/// as an event `collision`, one of two others as `crash_of_others`; what breaks and is dented is for the effects' next
/// step (advance_crashes). Call it once all participants have moved, before the snapshot is taken: its hash holds the
/// result.
void find_collisions(const Model& model, DrivenCar& car, std::vector<Participant>& participants, State& state,
                     std::vector<Event>& events);

}  // namespace septet::simulation
