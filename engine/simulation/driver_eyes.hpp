#pragma once
/// Whom the driver's eyes have before them: past vehicles, walls, houses and parked cars (sight/lookout.hpp), through smoke,
/// fog and what falls, and in the dark, by the law of sight_stage.hpp. In any direction: glances are the driver's own.
///
/// The snapshot carries it for the simulated driver. The log tells who comes into sight who was hidden, by the event
/// `first_sight`; one who is hidden for less than `remembered_s` is still known, and is not told again. Spray, hills,
/// trees, rails and railings hide nobody; through the windows of cars one sees.

#include <vector>

#include "engine/simulation/state.hpp"

namespace septet::simulation {

/// Looks ten times a second, from the first tick on.
void look_for_others(const Model& model, const std::vector<Participant>& participants, State& state,
                     std::vector<Event>& events);

/// True for one whom the driver has before his eyes, or had within `remembered_s`.
bool is_known(const State& state, ParticipantId id);

/// Those who are seen, as a keyframe; empty where nobody is near enough.
std::optional<EffectKeyframe> seen_keyframe(const State& state);

}  // namespace septet::simulation
