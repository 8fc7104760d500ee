#pragma once
/// Still ice of one drive: what lies on roofs, hangs below edges and covers lanes, how much of it is left, and its keyframe.

#include <vector>

#include "engine/effects/ice/ice_keyframe.hpp"
#include "engine/road/road_network.hpp"
#include "engine/scenario/scenario.hpp"
#include "engine/scenario/scenario_state.hpp"
#include "engine/simulation/effects/black_ice.hpp"

namespace septet::simulation {

struct IceState {
  ice::StillIce still;
  std::vector<BlackIce> black;  ///< One for each sheet of `still`, in its order.
  EffectKeyframe keyframe;      ///< No bytes while there is no ice.
};

/// Slabs that the storyboard will spill lie on their roofs from the start, where they find room; in frost, icicles hang at the
/// mouths of tunnels and along bridges.
IceState initial_ice(const road::RoadNetwork& roads, const scenario::Scenario& scenario,
                     const scenario::ScenarioState& storyboard, scenario::EntityIndex driver, ParticipantId driver_id,
                     ParticipantId first_id, std::uint64_t seed);

/// Puts a stretch of a lane under ice; nothing happens where the network has no such road or lane.
void freeze(const road::RoadNetwork& roads, const scenario::EffectAction& action, IceState& state);

/// How much of a slab's thickness is left, 0 to 1; it lies on its roof no more.
double release_slab(ParticipantId vehicle, const Vec2& place_m, double thickness_m, IceState& state);

/// Lets it thaw for `step_s`; the keyframe shows `shows`.
void advance_ice(double temperature_k, double step_s, Tick shows, IceState& state);

}  // namespace septet::simulation
