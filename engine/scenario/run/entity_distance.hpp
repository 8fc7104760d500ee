#pragma once
/// Distances between entities and to positions (OpenSCENARIO XML 1.3, "Distance computation").

#include "engine/road/road_network.hpp"
#include "engine/scenario/run/resolve_position.hpp"
#include "engine/scenario/run/scenario_state.hpp"

namespace septet::scenario {

/// Target of a distance measurement. A position has no box.
struct Target {
  Placement placement;
  const BoundingBox* box = nullptr;
};

/// Metres, never negative; infinite where the two are not on connected roads and the measure is along the road.
double distance_m(const road::RoadNetwork& network, const Entity& entity, const EntityState& from, const Target& target,
                  const DistanceMeasure& measure);

/// Along the roads' reference lines from one position to another, over any links; positive towards the end that
/// `along_s` faces; infinite where there is no path within 100 roads. `along_lanes`: on the first and the last road in
/// metres of the lanes of `from` and `to`, which a bend makes longer or shorter; on roads between along the reference
/// line.
double road_distance_m(const road::RoadNetwork& network, const road::LanePosition& from, bool along_s,
                       const road::LanePosition& to, bool along_lanes = false);

/// Closing speed by that measure, from their velocities.
double closing_speed_mps(const EntityState& from, const Placement& target, const Vec3& target_velocity_mps,
                         const DistanceMeasure& measure);

}  // namespace septet::scenario
