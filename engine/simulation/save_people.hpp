#pragma once
/// Members of people for the archive. Included by saved_state.cpp alone.

#include "engine/core/archive.hpp"
#include "engine/simulation/people_state.hpp"

namespace septet {
SEPTET_MEMBERS(PeopleWish, count, radius_m)
}

namespace septet::traffic {
// A person's looks and character were drawn when he came.
SEPTET_MEMBER_GROUPS(Person, hashed(id), kept(paint, desired_mps, leader, beside_m, ways),
                     hashed(outside, walk, forwards, next_walk, next_forwards, turns, at_m, left_m, position_m,
                            height_m, velocity_mps, wanted_mps, heading_rad, turns_radps, strides, crosses, asks,
                            waits_s, stuck_s))
SEPTET_MEMBERS(PeopleState, people, time_s, ticks, random)
}  // namespace septet::traffic

namespace septet::simulation {
SEPTET_MEMBERS(PeopleOfDrive, wish, swarm)
}
