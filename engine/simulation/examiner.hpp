#pragma once
/// Examiner's notes on the drive for the log: lines where others may have right of way, turns, posted limits.
///
/// "right_of_way", as the car's front passes a line: `kind` lights, give_way or crossing; `margin_s`, the time that was
/// left until a participant with right of way would have been in the car's path, 0 at a red light; lines that no
/// participant approaches are not logged, lights always. "turn", as it leaves a junction at which the road forks:
/// `side`, `began_s`. "speed_limit", where another one begins: `kmh`, 0 where none is posted. Log format: FORMAT.md. On
/// roads without such lines there is no examiner.

#include <span>
#include <vector>

#include "engine/simulation/model.hpp"
#include "engine/simulation/state.hpp"

namespace septet::simulation {

void advance_examiner(const Model& model, std::span<const Participant> participants, const Participant& car,
                      State& state, std::vector<Event>& events);

/// Notes from before this state that still hold, for a log that begins at it: the posted limit.
std::vector<Event> notes_in_force(const State& state);

}  // namespace septet::simulation
