#pragma once
/// Roads for their surroundings: evaluated anywhere, extended straight beyond loose ends, and cut into tiles.

#include <vector>

#include <glm/vec3.hpp>

#include "engine/road/road_network.hpp"
#include "engine/road/road_position.hpp"

namespace septet::roadside {

/// Stretch of one road with one lane section and one kind of surroundings. Its frame lies in its middle on the
/// reference line, x along the road, z up.
struct RoadTile {
  road::RoadIndex road = 0;
  double s0_m = 0.0, s1_m = 0.0;
  RigidTransform world_from_tile;
  bool in_tunnel = false, on_bridge = false;

  double middle_m() const { return 0.5 * (s0_m + s1_m); }
};

/// Length by which a road runs on beyond an end without a link.
inline constexpr double usual_overrun_m = 1500.0;

class RoadShape {
 public:
  /// `overrun_m`: length by which a road runs on beyond an end without a link. An overrun that would reach another
  /// road's lanes ends before them.
  RoadShape(const road::RoadNetwork& network, double overrun_m);

  const road::RoadNetwork& network() const { return network_; }
  const road::Road& road(road::RoadIndex index) const { return network_.roads[index]; }
  /// First and last station, overrun included.
  double begin_m(road::RoadIndex index) const;
  double end_m(road::RoadIndex index) const;

  road::RoadPoint at(road::RoadIndex index, double s_m, double t_m) const;
  /// Point `up_m` along the surface's normal.
  Vec3 point(road::RoadIndex index, double s_m, double t_m, double up_m = 0.0) const;
  /// Point in the tile's frame.
  glm::vec3 local(const RoadTile& tile, double s_m, double t_m, double up_m = 0.0) const;
  glm::vec3 local(const RoadTile& tile, const Vec3& world_m) const;

  /// Structure of a kind at a station, or nullptr.
  const road::RoadStructure* structure_at(road::RoadIndex index, double s_m, road::RoadStructure::Kind kind) const;

  /// Tiles of at most `length_m`, in order of road and station.
  std::vector<RoadTile> tiles(double length_m) const;

 private:
  double free_overrun_m(road::RoadIndex index, bool at_end, double most_m) const;

  const road::RoadNetwork& network_;
  std::vector<double> begins_m_, ends_m_;
};

/// Evenly spaced stations of a tile, both ends included, at most `step_m` apart.
std::vector<double> stations(const RoadTile& tile, double step_m);

/// Stations within a tile at which a lane's height steps.
std::vector<double> height_steps(const RoadShape& roads, const RoadTile& tile);
/// Same as `stations`, with those of height_steps, and so close that straight pieces between them leave the lanes'
/// edges by no more than 3 cm in plan and 1 cm in height (down to 0.6 m apart, at most some 128 of them): the drawn
/// bend lies where wheels find it.
std::vector<double> close_stations(const RoadShape& roads, const RoadTile& tile, double most_step_m);

}  // namespace septet::roadside
