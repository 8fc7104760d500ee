#pragma once
/// Houses and lamps along a town's streets, for the scenery that draws them and the cars that run against them.
///
/// The same network and seed give the same streets. No house stands on a lane of any road (a lawn excepted), in a
/// junction or before a signal; no lamp on a lane that is driven on. World frame, metres.

#include <cstdint>
#include <vector>

#include "engine/roadside/road_shape.hpp"

namespace septet::roadside {

enum class TownHouseKind : std::uint8_t { cottage, house, block };
inline constexpr int town_house_kind_count = 3, town_house_colour_count = 4;

/// Sizes along the street and away from it.
struct TownHouseSize {
  double length_m, depth_m;
};
TownHouseSize size_of(TownHouseKind kind);

struct TownHouse {
  TownHouseKind kind = TownHouseKind::house;
  int colour = 0;
  RigidTransform world_from_house;  ///< Pose of its middle at the ground; x along the street, which lies towards −y.
};
std::vector<TownHouse> town_houses(const RoadShape& roads, std::uint64_t seed);

struct StreetLamp {
  RigidTransform world_from_lamp;  ///< Pose of its foot; x towards the road.
};
/// Lamps of the file, or where it has none those planned by street_lighting.hpp.
std::vector<StreetLamp> street_lamps(const RoadShape& roads);

/// True if p lies in a house or within `margin_m` of it.
bool is_in_house(const std::vector<TownHouse>& houses, const Vec2& p, double margin_m);

}  // namespace septet::roadside
