#pragma once
/// What a place of the road is made of: the patch on top, else the lane's material (OpenDRIVE 1.8).

#include "engine/road/road_network.hpp"
#include "engine/road/road_position.hpp"

namespace septet::road {

/// Null where the file says nothing. A road without materials and patches costs one look.
const SurfaceMaterial* material_at(const RoadNetwork& network, const RoadPosition& position);

}  // namespace septet::road
