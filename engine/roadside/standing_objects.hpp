#pragma once
/// What a road file itself says stands beside its roads: buildings, lamps, trees, poles and whatever else has a height. What the scenery draws and what cars
/// run against. Where a file gives houses or lamps, none are made up (street.hpp).
///
/// OpenDRIVE 1.8, §13: objects by their type, along their repeats where they have some; their shape is their closed outline, else their
/// circle, else their box. Kerbs and islands are raised areas, barriers along the road lines (barrier_lines.hpp), gantries and crossings what they are elsewhere. Of a size that is not
/// given a usual one is taken. World frame, metres.

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "engine/roadside/road_shape.hpp"

namespace septet::roadside {

enum class StandingKind : std::uint8_t { building, lamp, tree, bush, pole, block };

struct StandingObject {
  StandingKind kind = StandingKind::block;
  RigidTransform world_from_object;  ///< Its foot; x as the object's u.
  double height_m = 1.0;
  double radius_m = 0.0;  ///< Of poles; of others 0.
  std::vector<Vec2>
      footprint_m;  ///< Of buildings and blocks: corners against the clock, in the object's frame; at least three.
};

inline constexpr std::size_t most_standing_objects = 5'000;
inline constexpr double highest_object_m = 200.0, widest_object_m = 300.0;

/// In the file's order; what is larger than the limits or has no extent is left out.
std::vector<StandingObject> standing_objects(const RoadShape& roads);

/// Does the file give any of this kind?
bool gives(const road::RoadNetwork& network, StandingKind kind);

}  // namespace septet::roadside
