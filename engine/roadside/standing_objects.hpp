#pragma once
/// Standing objects that a road file gives beside its roads: buildings, lamps, trees, poles and all others with a
/// height, for the scenery that draws them and the cars that run against them. Where a file gives houses or lamps, no
/// others are generated (street.hpp).
///
/// OpenDRIVE 1.8, §13: objects by their type, along their repeats where they have some; their shape is their closed
/// outline, else their circle, else their box. Left to other files: kerbs and islands (raised areas), barriers along
/// the road (barrier_lines.hpp), gantries and crossings. Missing sizes get usual values. World frame, metres.

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "engine/roadside/road_shape.hpp"

namespace septet::roadside {

enum class StandingKind : std::uint8_t { building, lamp, tree, bush, pole, block };

/// What a building's subtype says it is for.
enum class BuildingUse : std::uint8_t { unknown, shop, flats, house, hall, church, tower };

struct StandingObject {
  StandingKind kind = StandingKind::block;
  BuildingUse use = BuildingUse::unknown;
  RigidTransform world_from_object;  ///< Pose of its foot; x along the object's u.
  double height_m = 1.0;
  double radius_m = 0.0;  ///< Radius of poles; 0 for others.
  /// Corners of buildings and blocks, anticlockwise, in the object's frame; at least three.
  std::vector<Vec2> footprint_m;
};

inline constexpr std::size_t most_standing_objects = 5'000;
inline constexpr double highest_object_m = 200.0, widest_object_m = 300.0;

/// Objects in the file's order; those larger than the limits or without extent are left out.
std::vector<StandingObject> standing_objects(const RoadShape& roads);

/// True if the file gives any of this kind.
bool gives(const road::RoadNetwork& network, StandingKind kind);

}  // namespace septet::roadside
