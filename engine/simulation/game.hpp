#pragma once
/// A scenario as a game: follow the leader through its lanes, for as long as you can.
///
/// After M. Lebram, H. Engström and H. Gustavsson, "A Driving Simulator Based on Video Game Technology" (SIGRAD 2006),
/// section 4: the player drives on a five-lane motorway behind an ambulance, and it becomes harder by the intensity of
/// the traffic and the behaviour of others. The paper leaves open points, levels and the end, which are ours
/// (engine/scenario/model/game_settings.hpp has the figures).
///
/// - The leader changes to another of its lanes, one or two away, every so often, and more often on each level. It
///   waits until the place is free.
/// - A second within reach behind the leader is worth ten points times the level, and twice as much in the leader's own
///   lane.
/// - With each level more vehicles come in, and everybody's manners become worse (traffic::worsen).
/// - It ends when the leader has been too far away for too long, at the first vehicle touched, or when the time has
///   been survived.
///
/// Counted ten times a second, of simulated time. Same model, seed and inputs: same game.

#include <vector>

#include "engine/scenario/model/game_settings.hpp"
#include "engine/simulation/state.hpp"

namespace septet::simulation {

GameState initial_game(const scenario::GameSettings& settings, std::uint64_t seed);

/// Advances the game: the last stage before the snapshot, after this tick's collisions. Has no effect where there is no
/// game, or after its end.
void advance_game(const Model& model, const Participant& car, State& state, std::vector<Event>& events);

}  // namespace septet::simulation
