#pragma once
/// Traffic on a whole road network (town.hpp) as a TrafficEngine.

#include <cstdint>
#include <memory>

#include "engine/traffic/network/lane_graph.hpp"
#include "engine/traffic/traffic_engine.hpp"

namespace septet::traffic {

/// `network` outlives it.
std::unique_ptr<TrafficEngine> network_traffic(const road::RoadNetwork& network, LaneGraph graph, std::uint64_t seed);

}  // namespace septet::traffic
