#pragma once
/// Traffic to bytes and back (engine/core/archive.hpp). What is looked up of the road, the tables, is not kept but looked up again.

#include "engine/core/archive.hpp"
#include "engine/road/road_network.hpp"
#include "engine/traffic/traffic.hpp"

namespace septet::traffic {

void save_traffic(const TrafficParameters& parameters, const TrafficState& state, StateWriter& writer);

/// `reader` fails where it is no traffic of this network: then both are not to be used.
void restore_traffic(const road::RoadNetwork& network, StateReader& reader, TrafficParameters& parameters,
                     TrafficState& state);

}  // namespace septet::traffic
