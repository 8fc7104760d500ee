#pragma once
/// Houses and their walls in plan, for the scenery that draws them and the cars that run against them.

#include <cstdint>
#include <span>
#include <vector>

#include "engine/roadside/terrain.hpp"

namespace septet::roadside {

enum class BuildingKind : std::uint8_t { red_farm, white_farm, church };
inline constexpr int building_kind_count = 3;

/// A house in its building's frame.
struct HouseBlock {
  double length_m, width_m;  ///< Along x and y.
  double x_m, y_m;           ///< Position of its middle.
};
/// Blocks of a farm: dwelling, barn and shed; of a church: nave and tower.
std::span<const HouseBlock> house_blocks(BuildingKind kind);

struct Building {
  BuildingKind kind = BuildingKind::red_farm;
  RigidTransform world_from_building;
};
std::vector<Building> placed_buildings(const RoadShape& roads, const Terrain& terrain, std::uint64_t seed);

}  // namespace septet::roadside
