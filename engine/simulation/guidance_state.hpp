#pragma once
/// The state of the driver's guidance to a goal (guidance.hpp).

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/traffic/network/route_turns.hpp"
#include "engine/world/guidance.hpp"

namespace septet::simulation {

struct GuidanceState {
  std::vector<std::vector<traffic::PlaceOnLane>> goals;  ///< Still ahead, in their order: the lanes of each.
  traffic::LaneRoute route;
  std::uint64_t step = 0;                    ///< Of the route, where the car is…
  double along_m = 0.0;                      ///< …from the route's begin; of its middle.
  std::uint64_t turn = 0;                    ///< The next one of `turns`.
  bool soon_told = false, now_told = false;  ///< Of that turn.
  bool lane_told = false;
  bool arrived = false;
  std::uint32_t off_ticks = 0;   ///< Since the car was last on the route.
  std::uint32_t wait_ticks = 0;  ///< Until another route is sought again, where there was none.
  Guidance shown;
  Tick shown_at = 0, route_at = 0;                  ///< When that, and the route, last changed.
  std::shared_ptr<const traffic::LaneGraph> graph;  ///< Of the roads.
  std::vector<traffic::RouteTurn> turns;            ///< Of the route.
};

}  // namespace septet::simulation
