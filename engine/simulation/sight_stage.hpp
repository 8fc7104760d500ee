#pragma once
/// How far drivers see through the air ahead: fog, falling rain and snow, spray, smoke, and the dark, by one law (engine/sight/air.hpp).
///
/// A driver looks along his road, as it bends where he is, to the nearest vehicle or wall ahead, `farthest_sight_m` at most. He sees the road as far as
/// what reflects light is seen, and to a lit or burning vehicle as far as lamps are. Who sees less than `farthest_sight_m` is in the state, and in the
/// snapshot, until the next look: traffic and the simulated driver go so fast that they stop within that. The dark alone limits what is seen of dark
/// things, not the speed: posts, signs and markings send beams back, and people drive by them.
///
/// Drivers are that of the driver's car and those of traffic; scripted ones keep to their script.

#include <vector>

#include "engine/simulation/state.hpp"

namespace septet::simulation {

/// Looks four times a second; logs once a second what each driver sees who sees less.
void look_through_air(const Model& model, const std::vector<Participant>& participants, State& state,
                      std::vector<Event>& events);

/// The sights as a keyframe; empty where nobody's is limited.
std::optional<EffectKeyframe> sight_keyframe(const State& state);

}  // namespace septet::simulation
