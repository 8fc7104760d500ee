#pragma once
/// Crashes with what stands beside the road, of the driver's car and of loose bodies alike: told, recorded, and handed
/// to the effects.

#include <vector>

#include "engine/physics/vehicle/hull.hpp"
#include "engine/simulation/state.hpp"

namespace septet::simulation {

/// Whose hull has met something, as it is after the tick's steps.
struct HullOwner {
  ParticipantId id = 0;
  impact::Side side;
  double mass_centre_ahead_m = 0.0;
};

/// Records what the touches of a tick have done to their owner, and tells of those that are over: an event `collision`
/// of the driver's car, `crash_of_others` of a loose body. `before`: the touches as they were.
void note_hull(const HullOwner& owner, const std::vector<vehicle::HullTouch>& before, const vehicle::HullState& hull,
               const vehicle::HullReport& met, State& state, std::vector<Event>& events);

}  // namespace septet::simulation
