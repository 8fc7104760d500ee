#pragma once
/// Routes of 5 km and more through a network, and what does not hold of one.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include <doctest/doctest.h>

#include "engine/core/random.hpp"
#include "engine/traffic/network/lane_route.hpp"

namespace septet::traffic {

inline bool leads_to(const LaneGraph& graph, WayIndex from, WayIndex to) {
  const auto next = graph.next_of(graph.ways[from]);
  return std::ranges::find(next, to) != next.end();
}

/// Steps of which one does not follow the other, lanes changed within a junction, and begins that are not where the
/// steps before end.
inline int faults(const LaneGraph& graph, const LaneRoute& route) {
  int found = route.steps.front().begins_m == -route.from.at_m ? 0 : 1;
  for (std::size_t i = 0; i < route.steps.size(); ++i) {
    const RouteStep& step = route.steps[i];
    if (!is_beside(graph.ways[step.enters], graph.ways[step.leaves])) ++found;
    if (step.enters != step.leaves && graph.ways[step.enters].in_junction()) ++found;
    if (i == 0) continue;
    const RouteStep& before = route.steps[i - 1];
    if (!leads_to(graph, before.leaves, step.enters)) ++found;
    if (std::abs(step.begins_m - before.begins_m - graph.ways[before.leaves].length_m) > 1e-6) ++found;
  }
  if (route.steps.back().leaves != route.to.way) ++found;
  if (std::abs(route.length_m - route.steps.back().begins_m - route.to.at_m) > 1e-6) ++found;
  return found;
}

/// Ten routes of 5 km and more from drawn places over drawn ones.
inline void drives_ten_routes(const road::RoadNetwork& network) {
  const LaneGraph graph = build_lane_graph(network);
  std::vector<WayIndex> inner;
  for (WayIndex index = 0; index < graph.ways.size(); ++index)
    if (const Way& way = graph.ways[index]; way.goes_on && !way.in_junction() && way.length_m > 20.0)
      inner.push_back(index);
  REQUIRE(inner.size() > 10);
  Random random(38, 1);
  const auto draw = [&] {
    const WayIndex way = inner[static_cast<std::size_t>(random.uniform() * static_cast<double>(inner.size()))];
    return PlaceOnLane{way, 0.5 * graph.ways[way].length_m};
  };
  int routes = 0, tried = 0;
  while (routes < 10 && ++tried < 200) {
    const PlaceOnLane from = draw();
    std::vector<std::vector<PlaceOnLane>> over;
    std::optional<LaneRoute> route;
    for (int k = 0; k < 60 && (!route || route->length_m < 5000.0); ++k) {
      over.push_back({draw()});
      const auto longer = plan_route_over(graph, from, over);
      if (longer)
        route = longer;
      else
        over.pop_back();
    }
    if (!route || route->length_m < 5000.0) continue;
    ++routes;
    CHECK(faults(graph, *route) == 0);
    CHECK(route->time_s > route->length_m / 40.0);
  }
  CHECK(routes == 10);
}

}  // namespace septet::traffic
