#pragma once
/// Shape of the land: hills that follow the roads' level, cut and fill beside the roads, level ground between the streets of a town, a valley under every bridge
/// that crosses no road, and a hill over every tunnel. Where roads lie on two levels the ground follows the lower one.
///
/// A pure function of the world's x and y, built once from the roads. Metres, world frame.

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <glm/ext/vector_int2_sized.hpp>

#include "engine/roadside/lane_levels.hpp"
#include "engine/roadside/lowered_land.hpp"
#include "engine/roadside/road_shape.hpp"

namespace septet::roadside {

/// Position of a point relative to the nearest road.
struct Nearest {
  bool found = false;  ///< True within Terrain::reach_m.
  road::RoadIndex road = 0;
  double s_m = 0.0, t_m = 0.0;
  double outside_m = 0.0;  ///< Distance beyond the outermost lanes; 0 on the road.
  double axis_z_m = 0.0;   ///< Height of the reference line there.
  double edge_z_m = 0.0;   ///< Height of the road's surface at the nearest point of it.
  bool in_town = false;    ///< True beside a street of a town (town.hpp).

  /// True in the yards and gardens of a town, which reach this far from its streets.
  bool is_yard() const { return found && in_town && outside_m < yards_m; }
  static constexpr double yards_m = 100.0;
};

class Terrain {
 public:
  static constexpr double reach_m = 500.0;

  /// Holds no reference to `roads`.
  Terrain(const RoadShape& roads, std::uint64_t seed);

  double height_m(const Vec2& p) const { return height_m(p, nearest(p)); }
  double height_m(const Vec2& p, const Nearest& nearest) const;
  /// Limits of the ground beside lanes. `height_m` keeps to them as the drawn land's grid does.
  const LaneLevels& lanes() const { return lanes_; }
  Nearest nearest(const Vec2& p) const;
  /// Rough distance to the nearest road, at any range.
  double distance_m(const Vec2& p) const;

  /// True if p lies under or over a bridge's or tunnel's stretch, where no plants grow.
  bool is_kept_clear(const Nearest& nearest) const;
  /// True if p is near a tunnel's mouth, where the land breaks off at the portal.
  bool is_at_portal(const Nearest& nearest) const;
  /// Share of woodland at p, 0 to 1.
  double woodland(const Vec2& p) const;

  /// Result of roadside::squares_near for all roads.
  std::vector<glm::i64vec2> squares_near(double side_m, double within_m) const;

  Vec2 low_m() const { return low_m_; }
  Vec2 high_m() const { return high_m_; }

  struct Valley {
    Vec3 middle_m;
    Vec2 along;  ///< Direction of the road.
    double depth_m = 15.0;
    double bottom_z_m = 0.0;
  };
  const std::vector<Valley>& valleys() const { return valleys_; }
  /// Offset of the valley's floor from the straight line across the road, `across_m` from the bridge.
  static double meander_m(double across_m);

 private:
  struct Sample {
    road::RoadIndex road;
    double s_m;
    Vec3 position_m;
    Vec2 along;
    double roll_rad, left_m, right_m;
    double step_m;             ///< Distance to its neighbours.
    double back_m, forward_m;  ///< Lengths of road behind and ahead for which it determines the ground.
    bool in_town;
  };
  void add_samples(const RoadShape& roads, road::RoadIndex index);
  double land_m(const Vec2& p, const Nearest& nearest) const;
  struct Mouth {
    road::RoadIndex road;
    double s0_m, s1_m;
  };
  using Cell = std::pair<std::int64_t, std::int64_t>;
  void look_in(const Cell& cell, const Vec2& p, Nearest& best) const;

  std::uint64_t seed_;
  LaneLevels lanes_;
  LoweredLand lowered_;
  std::vector<Sample> samples_, coarse_;
  std::map<Cell, std::vector<std::uint32_t>> cells_;
  std::vector<Valley> valleys_;
  std::vector<Mouth> structures_, tunnels_;  ///< Structures of all kinds; those that are tunnels.
  Vec2 low_m_{1e9}, high_m_{-1e9};
};

/// Lower corners, in steps of `side_m`, of all squares whose middle lies within `reach_m` of one of the places along x
/// and along y, and of some beyond; row by row. The area between places far apart is not visited.
std::vector<glm::i64vec2> squares_near(const std::vector<Vec2>& places, double side_m, double reach_m);

/// Interpolates from 0 below `low` to 1 above `high`, smooth between.
double smooth_step(double low, double high, double x);

}  // namespace septet::roadside
