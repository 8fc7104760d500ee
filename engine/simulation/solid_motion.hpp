#pragma once
/// Solids in motion by themselves, and when that ends.
///
/// At each tick the box of such a solid is where its thing is drawn at that tick, with the velocity that this has; wheels,
/// ground and what stands beside the road do nothing to it. One with a mass follows its motion until something pushes it:
/// from then on it is free, a body like a box of the scenario that was hit. One without a mass goes its way whatever it
/// meets. A motion that leaves the range of solids.hpp ends, and the box rests where it last was.

#include <cstdint>
#include <vector>

#include "engine/scene/motion.hpp"
#include "engine/simulation/bodies/bodies_state.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::simulation {

struct State;

/// A solid that follows its motion.
struct SolidMotion {
  ParticipantId participant = 0;
  Vec3 foot_m{0.0};  ///< Middle of its bottom from the point that it turns about, before the first leg; world axes.
  double heading_rad = 0.0;  ///< Before the first leg.
  scene::Motion motion;      ///< Of that point; turns about the vertical alone.
};

/// Where the motion has the body at a time, and its velocity.
void place_solid(const SolidMotion& moving, double simulated_time_s, LooseBody& body);

/// Brings all to the state's time. Those whose motion leaves its range rest.
void lead_solids(State& state);

/// Frees those that this tick has pushed: their body is not as their motion has it. Their participants show it.
void free_pushed_solids(State& state, std::vector<Participant>& participants);

/// True where the solid follows its motion.
bool is_led(const State& state, ParticipantId participant);

}  // namespace septet::simulation
