#pragma once
/// The route by which a driver goes, as the snapshot tells it (engine/world/guidance.hpp): the roads ahead as a corridor,
/// on which lanes keep their numbers from road to road, and the lane for the next turn.
///
/// The corridor holds a stretch of the route on which no road comes twice; another one is laid out before its end, in
/// which x and lanes go on as they were. Threads: one at a time.

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "engine/driver/driver_view.hpp"
#include "engine/traffic/network/lane_route.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::driver {

struct RouteAhead {
  std::shared_ptr<const traffic::LaneGraph> graph;  ///< Of the roads, once there was a route.
  traffic::LaneRoute route;                         ///< Without steps: there is none.
  std::optional<Tick> found_at;                     ///< The keyframe's.
  std::size_t step = 0;                             ///< Where the car was last.
  std::size_t first = 0;                            ///< Step of the corridor's first piece.
  double goal_x_m = 0.0;                            ///< Infinite where the corridor ends before the goal.

  bool leads() const { return !route.steps.empty(); }
};

/// Takes over the snapshot's route; true: it is another one than before, or there is none any more.
bool learn_route(RouteAhead& ahead, const road::RoadNetwork& network, const Snapshot& snapshot);

/// The corridor through the car's place on the route. `before`: the one until now, which it continues if the car is on
/// it. Empty: the car is not on the route.
std::optional<traffic::Corridor> route_corridor(RouteAhead& ahead, const road::RoadNetwork& network,
                                                const Snapshot& snapshot, const traffic::Corridor* before);

/// True where the corridor ends soon and the route goes on.
bool needs_more(const RouteAhead& ahead, const traffic::Corridor& corridor, double x_m);

/// Number of the lane in which the next junction is to be entered, or, where there is none ahead, the goal's; and the
/// distance to it.
struct WantedLane {
  int lane = 0;
  double within_m = 0.0;
};
WantedLane wanted_lane(RouteAhead& ahead, const traffic::Corridor& corridor, double x_m);

/// True within a junction of the route and a few metres before it.
bool is_at_junction(const RouteAhead& ahead, const traffic::Corridor& corridor, double x_m);

}  // namespace septet::driver
