#pragma once
/// Material of a place of the road: the patch on top, else the lane's material (OpenDRIVE 1.8).

#include "engine/road/road_network.hpp"
#include "engine/road/road_position.hpp"

namespace septet::road {

/// Null where the file gives none. A road without materials and patches costs one test.
const SurfaceMaterial* material_at(const RoadNetwork& network, const RoadPosition& position);

}  // namespace septet::road
