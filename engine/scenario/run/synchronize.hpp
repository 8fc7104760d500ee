#pragma once
/// SynchronizeAction (OpenSCENARIO XML 1.3): two entities reach their targets at the same time.
///
/// Of the ways to be there in time the one whose greatest acceleration is least: evenly up and evenly down (or down and up) where
/// the file gives a final speed, else one even change. It is found anew in each step, as the master may change its speed. Pure
/// functions.

#include "engine/road/road_network.hpp"
#include "engine/scenario/run/resolve_position.hpp"

namespace septet::scenario {

/// What is left of the synchronization.
struct Rendezvous {
  double way_m = 0.0, time_s = 0.0;
  std::optional<double> final_mps;
};

/// The speed dt later. Never backwards: who is early stands and waits.
double next_meeting_mps(const Rendezvous& left, double speed_mps, double dt_s);

/// What a SynchronizeAction is about, as it started.
struct Meeting {
  Placement target, master_target;
  SynchronizeAction what;
};

/// Nothing where one of the targets has no place.
std::optional<Meeting> plan_meeting(const road::RoadNetwork& network, const ScenarioState& state,
                                    const SynchronizeAction& what);

/// The speed with which it ends at this moment; nothing: any.
std::optional<double> final_mps(const Meeting& meeting, const ScenarioState& state);

/// What is left at this moment; nothing when one of the two is there (or past it), which ends the action.
std::optional<Rendezvous> left_of(const road::RoadNetwork& network, const ScenarioState& state, const Meeting& meeting,
                                  const EntityState& actor, double dt_s);

}  // namespace septet::scenario
