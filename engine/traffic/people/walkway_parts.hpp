#pragma once
/// The parts of which build_walkways makes its graph. Used by engine/traffic/people only.

#include <vector>

#include "engine/traffic/people/walkways.hpp"

namespace septet::traffic {

struct WalkPart {
  std::vector<WalkPoint> line;  ///< Places, widths and rises; the rest is found as it is joined.
  bool in_junction = false;
};

struct CrossingPart {
  Crossing crossing;
  WalkPart walk;
};

/// Crossings in the order of their roads, along each.
std::vector<CrossingPart> crossing_parts(const road::RoadNetwork& network, const WalkwaySurroundings& surroundings);

/// Pavements along roads, parted at crossings.
std::vector<WalkPart> pavement_parts(const road::RoadNetwork& network, const std::vector<CrossingPart>& crossings,
                                     const WalkwaySurroundings& surroundings);

}  // namespace septet::traffic
