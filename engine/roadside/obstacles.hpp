#pragma once
/// All that stands beside the roads and can be hit, found by place.
///
/// Worked out once, from the same lines and places that the scenery draws (barrier_lines.hpp, plants.hpp, buildings.hpp,
/// tunnel_shape.hpp). Then const, safe to read from many threads. The same network and seed give the same obstacles.
///
/// Trees and houses stand on the land, and reach over and under it without end here: whoever is beside the road is on it.

#include <cstdint>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "engine/roadside/road_shape.hpp"
#include "engine/roadside/terrain.hpp"
#include "engine/world/obstacle.hpp"

namespace septet::roadside {

/// Sideways from a gantry's middle to its legs.
std::vector<double> gantry_legs_m(double gantry_width_m);

class Obstacles {
 public:
  Obstacles(const road::RoadNetwork& network, std::uint64_t seed, double overrun_m = roadside::usual_overrun_m);

  /// Those within `reach_m` (at most 30) of p in plan, in a fixed order, woods' stems too; none where p is no number.
  std::vector<Obstacle> near(const Vec2& p, double reach_m) const;

  /// The land on which they stand.
  const Terrain& terrain() const { return terrain_; }

  /// All but the stems of woods.
  std::span<const Obstacle> listed() const { return obstacles_; }

 private:
  void close_ends();
  void index();

  std::uint64_t seed_;
  Terrain terrain_;
  std::vector<Obstacle> obstacles_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;  ///< Of the list, ascending.
  std::unordered_set<std::uint64_t> treeless_;                           ///< Cells too near to a road for woods.
};

}  // namespace septet::roadside
