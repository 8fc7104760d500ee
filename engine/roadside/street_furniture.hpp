#pragma once
/// Small things on the pavements of a town, and lids in its streets, for the scenery that draws them and the cars that
/// run against them.
///
/// The same network and seed give the same things. They stand on pavements that leave room to walk, clear of signals,
/// crossings and junctions. World frame, metres.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/roadside/road_shape.hpp"

namespace septet::roadside {

enum class FurnitureKind : std::uint8_t {
  bin,
  bench,
  letter_box,
  cabinet,
  advertising_column,
  cycle_stands,
  planter,
  bollard,
  gully,
  manhole,
};
inline constexpr int furniture_kind_count = 10;

struct Furniture {
  FurnitureKind kind = FurnitureKind::bin;
  RigidTransform world_from_thing;  ///< Pose of its foot; x along the street, which lies towards −y.
};

/// Radius in which a car is held; 0 for what lies in the ground.
double radius_of(FurnitureKind kind);

inline constexpr std::size_t most_furniture = 6000;
std::vector<Furniture> street_furniture(const RoadShape& roads, std::uint64_t seed);

}  // namespace septet::roadside
