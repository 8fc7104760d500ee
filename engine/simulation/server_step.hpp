#pragma once
/// One tick of a drive. The stages, and the feedback from one tick to the next:
///
///     driver input → car → storyboard → traffic → bodies → effects → collisions → snapshot
///
/// `Model` is const after loading; `State` is everything that changes. No file, socket or clock here (a traffic engine
/// that has a socket keeps it to itself): the same model, seed and inputs give the same state hash at every tick.

#include <memory>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/simulation/state.hpp"

namespace septet::simulation {

/// The state at tick 0, after the scenario's Init actions. Error: a scenario that does not fit its road, or `traffic`
/// fails.
Expected<State> initial_state(const Model& model, std::unique_ptr<traffic::TrafficEngine> traffic);

/// Advances by one tick; returns the snapshot of the new tick. Events are appended. `old` is a spare snapshot: its
/// memory is reused.
Snapshot server_step(const Model& model, const DriverInput& input, State& state, std::vector<Event>& events,
                     Snapshot old = {});

/// The state as a snapshot: const from here on.
Snapshot capture_snapshot(const Model& model, const State& state, Snapshot old = {});

}  // namespace septet::simulation
