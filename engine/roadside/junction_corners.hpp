#pragma once
/// Pavements round the corners of junctions, where a file has pavements along the roads that meet there and leaves
/// the corner between them bare.
///
/// The kerb follows the outer border of the lane that turns there, else an arc that continues both roads' kerbs. A
/// corner whose pavement would lie on a lane that is driven on is left bare. World frame, metres.

#include <vector>

#include "engine/road/road_network.hpp"

namespace septet::roadside {

struct JunctionCorner {
  road::RoadIndex road = 0;  ///< One of the roads that end there.
  double s_m = 0.0;          ///< Station of that end.
  /// Lines from one road to the other, with equally many points at the pavement's height: along the kerb, and along
  /// its far edge.
  std::vector<Vec3> kerb_m, edge_m;
};

std::vector<JunctionCorner> junction_corners(const road::RoadNetwork& network);

}  // namespace septet::roadside
