#pragma once
/// Where houses stand, and their walls in plan: what the scenery draws and what cars run against.

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
  double x_m, y_m;           ///< Of its middle.
};
/// A farm's dwelling, barn and shed; a church's nave and tower.
std::span<const HouseBlock> house_blocks(BuildingKind kind);

struct Building {
  BuildingKind kind = BuildingKind::red_farm;
  RigidTransform world_from_building;
};
std::vector<Building> placed_buildings(const RoadShape& roads, const Terrain& terrain, std::uint64_t seed);

}  // namespace septet::roadside
