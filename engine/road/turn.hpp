#pragma once
/// Direction of a turn at a fork, as an indicator shows it.

#include "engine/road/road_network.hpp"

namespace septet::road {

/// 1 to the left, −1 to the right, 0 straight on or no fork, for a car that drives through a connecting road of a
/// junction from the road before it. Straight on is where the wheel keeps its position: along the ring of a roundabout,
/// too. `along_s`: through it towards increasing s; `lane`: the one that is driven.
int turn_through(const RoadNetwork& network, RoadIndex connecting, int lane, bool along_s);

}  // namespace septet::road
