#pragma once
/// SynchronizeAction (OpenSCENARIO XML 1.3): two entities reach their targets at the same time.
///
/// Of the speed curves that arrive in time, the one with the least peak acceleration: evenly up and evenly down (or
/// down and up) where the file gives a final speed, else one even change. It is computed anew in each step, as the
/// master may change its speed. Pure functions.

#include "engine/road/road_network.hpp"
#include "engine/scenario/run/resolve_position.hpp"

namespace septet::scenario {

/// Remaining part of the synchronization.
struct Rendezvous {
  double way_m = 0.0, time_s = 0.0;
  std::optional<double> final_mps;
};

/// The speed dt later. Never backwards: an early entity stands and waits.
double next_meeting_mps(const Rendezvous& left, double speed_mps, double dt_s);

/// Data of a SynchronizeAction, as of its start.
struct Meeting {
  Placement target, master_target;
  SynchronizeAction what;
};

/// Empty where one of the targets has no place.
std::optional<Meeting> plan_meeting(const road::RoadNetwork& network, const ScenarioState& state,
                                    const SynchronizeAction& what);

/// Its final speed at this moment; empty: any.
std::optional<double> final_mps(const Meeting& meeting, const ScenarioState& state);

/// The remaining part at this moment; empty when one of the two has arrived (or passed it), which ends the action.
std::optional<Rendezvous> left_of(const road::RoadNetwork& network, const ScenarioState& state, const Meeting& meeting,
                                  const EntityState& actor, double dt_s);

}  // namespace septet::scenario
