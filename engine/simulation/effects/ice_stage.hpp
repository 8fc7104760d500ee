#pragma once
/// Still ice of one drive: on roofs, below edges and on lanes, the remaining thickness, and its keyframe.

#include <vector>

#include "engine/effects/ice/glass_keyframe.hpp"
#include "engine/effects/ice/ice_keyframe.hpp"
#include "engine/road/road_network.hpp"
#include "engine/scenario/model/scenario.hpp"
#include "engine/scenario/run/scenario_state.hpp"
#include "engine/simulation/effects/black_ice.hpp"
#include "engine/simulation/effects/crashes.hpp"

namespace septet::simulation {

struct IceState {
  ice::StillIce still;
  std::vector<BlackIce> black;    ///< One for each sheet of `still`, in its order.
  std::vector<ice::Pane> panes;   ///< Windscreens with frost or cracks.
  EffectKeyframe keyframe;        ///< Empty while there is no ice.
  EffectKeyframe glass_keyframe;  ///< Keyframe of panes, likewise.
};

/// Lays slabs that the storyboard will spill on their roofs from the start, where they find room; in frost, icicles
/// hang at the mouths of tunnels and along bridges, and the driver's windscreen has as much of a morning's frost as the
/// scenario requests (septet:frost of Init's environment; otherwise none). The keyframes show tick 0.
IceState initial_ice(const road::RoadNetwork& roads, const scenario::Scenario& scenario,
                     const scenario::ScenarioState& storyboard, scenario::EntityIndex driver, ParticipantId driver_id,
                     ParticipantId first_id, std::uint64_t seed);

/// Puts a stretch of a lane under ice; has no effect where the network has no such road or lane.
void freeze(const road::RoadNetwork& roads, const scenario::EffectAction& action, IceState& state);

/// Takes a slab off its roof; returns the share of its thickness that is left, 0 to 1.
double release_slab(ParticipantId vehicle, const Vec2& place_m, double thickness_m, IceState& state);

/// Cracks a windscreen by an impact, or takes it out of its car; has no effect at walking pace, and where there are
/// stars enough.
void shake_glass(const ShakenGlass& glass, IceState& state);

struct IceWeather {
  double temperature_k = 288.15;
  double driver_speed_mps = 0.0;  ///< Speed of the car whose windscreen is warmed.
};
/// Thaws the ice for `step_s`; the keyframes show `shows`.
void advance_ice(const IceWeather& weather, double step_s, Tick shows, IceState& state);

}  // namespace septet::simulation
