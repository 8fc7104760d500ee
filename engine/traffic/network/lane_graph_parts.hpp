#pragma once
/// Steps of building a lane graph. Used by engine/traffic/network only.

#include "engine/traffic/network/lane_graph.hpp"

namespace septet::traffic {

/// Fills `conflicts` from the points: in each junction every two ways that come nearer than `meeting_m`, unless one
/// follows the other. And `long_conflicts`: pairs that come no nearer than that, but so near that two long vehicles
/// would touch.
void find_conflicts(LaneGraph& graph);

/// Ranks of connections by signs and by roundabouts; stop lines and lights of the ways before them.
void find_right_of_way(const road::RoadNetwork& network, LaneGraph& graph);

}  // namespace septet::traffic
