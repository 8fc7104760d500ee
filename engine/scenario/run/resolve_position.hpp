#pragma once
/// Places on the road and in the world of the file's positions.

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/road/road_network.hpp"
#include "engine/scenario/run/scenario_state.hpp"

namespace septet::scenario {

/// A place with its pose. Off every road only the pose counts.
struct Placement {
  bool on_road = false;
  road::LanePosition lane;
  bool along_s = true;              ///< Faces increasing s.
  double heading_offset_rad = 0.0;  ///< Against the direction of travel of the lane, in (−π/2, π/2].
  RigidTransform pose;
};

/// Empty where the position is not supported, names no road or lane of the network, or is relative to an entity without
/// a position. Stations beyond a road's end continue along its lanes.
std::optional<Placement> resolve_position(const road::RoadNetwork& network, const ScenarioState& state,
                                          const Position& position);

/// The place of a pose: in the nearest lane, if it stands no further beside the road than that.
inline constexpr double beside_road_m = 20.0;
Placement place_at(const RigidTransform& pose, const road::RoadNetwork& network,
                   const road::RoadPosition* hint = nullptr, double most_beside_m = beside_road_m);

/// Reason why resolve_position finds no place for a position, for messages: "road 7 has no lane -5 at s = 12".
std::string why_nowhere(const Scenario& scenario, const road::RoadNetwork& network, const ScenarioState& state,
                        const Position& position);

/// t of an entity on its road.
double lateral_t_m(const road::RoadNetwork& network, const road::LanePosition& lane);
/// The lane that holds the entity, which during a lane change is not the target lane.
int lane_of(const road::RoadNetwork& network, const EntityState& entity);
/// The lane `count` lanes to the left in the direction of travel; lane 0 does not count.
int lane_beside(int lane, bool along_s, int count);

/// The pose on a lane, facing along or against s, its path leaving the lane's centre line by
/// `slope` metres per metre of travel to the left.
RigidTransform lane_pose(const road::RoadNetwork& network, const road::LanePosition& lane, bool along_s, double slope,
                         double heading_offset_rad);

/// Advances along the lane in the entity's direction (backwards if negative), at junctions along the route, without one
/// straight on. `left_over_m` is the distance not driven because the road ends.
struct Progress {
  road::LanePosition lane;
  bool along_s = true;
  double left_over_m = 0.0;
};
Progress go_along(const road::RoadNetwork& network, const road::LanePosition& lane, bool along_s, double distance_m,
                  std::span<const road::RoadIndex> route = {});

/// The routes of a scenario with waypoints independent of entities; null for the others.
std::vector<std::shared_ptr<const PlannedRoute>> plan_routes(const road::RoadNetwork& network,
                                                             const Scenario& scenario);

/// The roads of a route from the entity's place, or of the route that it is on.
std::vector<road::RoadIndex> plan_from(const road::RoadNetwork& network, const ScenarioState& state,
                                       const EntityState& entity, const std::vector<Position>& waypoints);

}  // namespace septet::scenario
