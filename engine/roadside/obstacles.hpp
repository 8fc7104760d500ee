#pragma once
/// Collision obstacles beside the roads, found by place.
///
/// Computed once, from the same lines and places that the scenery draws (barrier_lines.hpp, plants.hpp, buildings.hpp,
/// tunnel_shape.hpp). Then const, safe to read from many threads. The same network and seed give the same obstacles.
///
/// Trees and houses stand on the land, and reach over and under it without end here: a vehicle beside the road is on
/// the land.

#include <cstdint>
#include <map>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "engine/roadside/road_shape.hpp"
#include "engine/roadside/terrain.hpp"
#include "engine/sight/walls.hpp"
#include "engine/world/obstacle.hpp"

namespace septet::roadside {

/// Lateral offsets of a gantry's legs from its middle.
std::vector<double> gantry_legs_m(double gantry_width_m);

class Obstacles {
 public:
  Obstacles(const road::RoadNetwork& network, std::uint64_t seed, double overrun_m = roadside::usual_overrun_m);

  /// Obstacles within `reach_m` (at most 30) of p in plan, in a fixed order, woods' stems too; empty where p is not
  /// finite. `gone`: things that are left out, ascending.
  std::vector<Obstacle> near(const Vec2& p, double reach_m, std::span<const std::uint32_t> gone = {}) const;

  /// Number of the thing (Obstacle::thing) whose object stands at this place, to the millimetre; 0: there is none.
  std::uint32_t thing_at(const Vec2& place_m) const;
  /// Numbers go from 1 to this one.
  std::uint32_t things() const { return static_cast<std::uint32_t>(things_.size()); }

  /// Land on which they stand.
  const Terrain& terrain() const { return terrain_; }

  /// All obstacles but the stems of woods.
  std::span<const Obstacle> listed() const { return obstacles_; }

  /// Those of them that hide what is behind: walls, portals, houses and parked cars, these to their windows.
  const sight::Walls& walls() const { return walls_; }

 private:
  void close_ends();
  void index();

  std::uint64_t seed_;
  Terrain terrain_;
  std::vector<Obstacle> obstacles_;
  sight::Walls walls_;
  std::map<std::pair<std::int64_t, std::int64_t>, std::uint32_t> things_;  ///< By place, in millimetres.
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;    ///< Ascending indices into the list.
  std::unordered_set<std::uint64_t> treeless_;                             ///< Cells too near to a road for woods.
};

}  // namespace septet::roadside
