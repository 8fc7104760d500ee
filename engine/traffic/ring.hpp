#pragma once
/// A ring full of traffic: the test track of traffic models, for it has neither ends nor ramps and keeps its density.

#include <cstdint>

#include "engine/traffic/traffic.hpp"

namespace septet::traffic {

/// A circle of right-hand traffic, driven along s, lanes −1 to −lanes of 3.75 m.
road::RoadNetwork ring_road(double length_m, int lanes);

/// `count` vehicles of the motorway's mix, spread evenly over the lanes of a ring_road, a third of those on the two
/// outer lanes lorries, drivers from timid to aggressive, each at the speed that its gap allows.
TrafficState dense_ring(const road::RoadNetwork& network, int lanes, std::uint32_t count, std::uint64_t seed);

}  // namespace septet::traffic
