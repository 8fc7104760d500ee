#pragma once
/// Traffic to bytes and back (engine/core/archive.hpp). Tables of road data are not saved but looked up again.

#include "engine/core/archive.hpp"
#include "engine/road/road_network.hpp"
#include "engine/traffic/traffic.hpp"

namespace septet::traffic {

void save_traffic(const TrafficParameters& parameters, const TrafficState& state, StateWriter& writer);

/// `reader` fails on data that is not traffic of this network: then both are not to be used.
void restore_traffic(const road::RoadNetwork& network, StateReader& reader, TrafficParameters& parameters,
                     TrafficState& state);

}  // namespace septet::traffic
