#pragma once
/// People of a swarm as a stage of the tick: before traffic, which lets them pass.
///
/// They come when the scenario asks for them (`septet:people`), walk on the drive's walkways, see vehicles as those stood a tick
/// before, and leave these rails when a vehicle throws them (thrown_stage.hpp).

#include <span>
#include <vector>

#include "engine/simulation/driver_car.hpp"
#include "engine/simulation/state.hpp"
#include "engine/traffic/crossing.hpp"

namespace septet::simulation {

/// The model's crossings, in their order.
std::vector<traffic::CrossingPlace> crossing_places(const Model& model);

/// People come in the place of those before.
void start_people(const Model& model, const PeopleWish& wish, const Participant& car, State& state);

/// Moves all by a tick, and tells traffic who is at its crossings.
void advance_people(const Model& model, const Participant& car, State& state);

/// Requires that all indices are within the model's walkways.
void require_sound(StateReader& reader, const Model& model, const PeopleOfDrive& people);

}  // namespace septet::simulation
