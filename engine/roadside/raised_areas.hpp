#pragma once
/// Kerbs and traffic islands that a road file gives as objects, and pavements round the corners of junctions
/// (junction_corners.hpp), for the scenery that draws them and the wheels that climb them.
///
/// OpenDRIVE 1.8, §13: objects of type `trafficIsland`, and any object (but paint) whose type, subtype or name says
/// kerb or curb; the standard has no type of its own for a single kerb. Their shape is their outlines, else their box
/// or circle, along their repeats where they have some. An outline that is not closed is a kerb stone along its line.
/// Objects higher than `highest_kerb_m` are walls and left out here. (Kerbs that are lanes of another height belong to
/// the road's surface.)
///
/// Computed once, then const, safe to read from many threads. World frame, metres.

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "engine/road/road_network.hpp"
#include "engine/roadside/junction_corners.hpp"

namespace septet::roadside {

inline constexpr double highest_kerb_m = 0.3;

struct RaisedArea {
  road::RoadIndex road = 0;  ///< Road of the object.
  double s_m = 0.0;          ///< Station of its beginning.
  std::vector<Vec3> top_m;   ///< Corners of its upper edge, world frame; the last one is joined to the first.
  Vec2 low_m{0.0}, high_m{0.0};
  bool is_grown = false;  ///< Grass within its kerb, by the object's subtype.
};

class RaisedAreas {
 public:
  explicit RaisedAreas(const road::RoadNetwork& network);

  /// World z of the ground at p where the road's surface lies at `road_z_m`: that, or the highest area within a metre
  /// above it (others lie on a bridge). Inside an area the height is that of the nearest place of its edge, so that a
  /// lowered stretch is lowered across.
  double ground_at(const Vec2& p, double road_z_m) const;
  /// True if an area may lie within `reach_m` (at most 1) of p.
  bool is_near(const Vec2& p, double reach_m) const;

  /// Areas of the file's objects.
  std::span<const RaisedArea> of_objects() const { return {areas_.data(), areas_.size() - corners_.size()}; }
  std::span<const JunctionCorner> corners() const { return corners_; }
  /// False where the file has more or larger ones than the limits (engine/road/CHECKS.md): the rest is left out.
  bool complete() const { return complete_; }

 private:
  std::vector<RaisedArea> areas_;  ///< Those of the objects, then one for each corner.
  std::vector<JunctionCorner> corners_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;  ///< Areas by cell, with a metre around each.
  bool complete_ = true;
};

}  // namespace septet::roadside
