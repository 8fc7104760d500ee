#pragma once
/// Guidance of the driver to a goal, as a driving instructor gives it: a route from where the car is, each turn told
/// early and again at it, the lane for it, a new route when the car is off the old one, and the arrival.
///
/// Early is `early_s` before the turn and at least `early_m`, after the crossing before it; again at `again_m`. Each word
/// is an event "guidance" (FORMAT.md). Ten looks a second. Off the route for `off_s`, another one is sought and told.
/// Same model, seed and inputs: same words.

#include <optional>
#include <string_view>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/road/road_position.hpp"
#include "engine/simulation/model.hpp"
#include "engine/simulation/state.hpp"

namespace septet::simulation {

inline constexpr double early_s = 9.0, early_m = 100.0, again_m = 50.0, again_s = 3.0, off_s = 0.5;

/// Guides the car from where it is to a place that a person names (traffic::find_goal); empty: no more. Error: no such
/// place, no lanes lead there, or the car is in no lane; then nothing has changed.
Expected<void> guide(const Model& model, std::string_view place, State& state, std::vector<Event>& events);
/// The same over several lanes' places. Those that lie behind the car at first are left out.
Expected<void> guide_over(const Model& model, const std::vector<road::LanePosition>& places, State& state,
                          std::vector<Event>& events);

/// A stage of the tick: where the car is on its route, and what it is told.
void advance_guidance(const Model& model, const Participant& car, State& state, std::vector<Event>& events);

/// What follows from the rest of a state that was kept. False: it does not fit the roads.
bool complete_guidance(const Model& model, GuidanceState& guidance);

/// Both of its effects, for the snapshot.
void append_guidance(const State& state, std::vector<EffectKeyframe>& effects);

}  // namespace septet::simulation
