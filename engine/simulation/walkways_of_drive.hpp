#pragma once
/// Walkways of a drive: its roads' pavements and crossings with what stands beside the roads, for people of a swarm.

#include <vector>

#include "engine/road/road_network.hpp"
#include "engine/roadside/obstacles.hpp"
#include "engine/roadside/raised_areas.hpp"
#include "engine/simulation/model.hpp"
#include "engine/traffic/people/walkways.hpp"

namespace septet::simulation {

/// Corners of junctions, posts and trunks, lights for people. `lights` are those of Model::lights.
traffic::WalkwayGraph walkways_of(const road::RoadNetwork& roads, const roadside::Obstacles& obstacles,
                                  const roadside::RaisedAreas& raised, const std::vector<SwitchedLight>& lights);

}  // namespace septet::simulation
