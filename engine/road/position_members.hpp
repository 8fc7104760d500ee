#pragma once
/// Member lists of positions in a road network, for engine/core/archive.hpp.

#include <cmath>

#include "engine/core/archive.hpp"
#include "engine/road/road_position.hpp"

namespace septet::road {

SEPTET_MEMBERS(RoadPosition, road, s_m, t_m)
SEPTET_MEMBERS(LanePosition, road, lane, s_m, offset_m)

/// Requires that positions from outside lie on an existing road.
inline void require_on_roads(StateReader& reader, const RoadNetwork& roads, const RoadPosition& position) {
  reader.require(position.road < roads.roads.size() && std::isfinite(position.s_m) && std::isfinite(position.t_m),
                 "a place in it is on no road");
}
inline void require_on_roads(StateReader& reader, const RoadNetwork& roads, const LanePosition& position) {
  reader.require(position.road < roads.roads.size() && std::isfinite(position.s_m) && std::isfinite(position.offset_m),
                 "a place in it is on no road");
}

}  // namespace septet::road
