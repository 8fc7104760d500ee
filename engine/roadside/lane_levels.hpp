#pragma once
/// Limit of the ground's height under and beside lanes.
///
/// Ground is earth: over no lane that is driven or walked, and beside one no steeper than it stands by itself, 1 in 1.5
/// (a steeper bank is held by a wall along the upper road). Lanes are known by places of their surface, at most
/// `along_step_m` and `across_step_m` apart; land over tunnels is left out, and ground under a bridge
/// stays below its deck.
///
/// Built once from the roads, const from there on. Metres, world frame.

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "engine/math/plane_cells.hpp"
#include "engine/roadside/road_shape.hpp"

namespace septet::roadside {

/// True of lanes for people on foot or on bicycles.
bool is_walked(road::LaneType type);

class LaneLevels {
 public:
  static constexpr double along_step_m = 1.0, across_step_m = 2.0;
  /// Rise over run of earth that needs no wall.
  static constexpr double steepest = 1.0 / 1.5;
  /// Height of the air below a deck's lanes.
  static constexpr double deck_room_m = 1.6;

  struct Place {
    Vec2 p;
    double most_m = 0.0;   ///< Ground here lies no higher.
    bool carried = false;  ///< True on a bridge: ground beside it does not matter.
  };

  explicit LaneLevels(const RoadShape& roads);

  /// Returns `z_m`, or less where ground so high would lie over a lane or too steeply beside one.
  double limited_m(const Vec2& p, double z_m) const;

  /// Calls `visit` with each place in the box and some around it.
  template <class Visit>
  void for_each(const Vec2& low_m, const Vec2& high_m, const Visit& visit) const {
    cells.for_each(low_m, high_m, [&](std::uint64_t key) {
      if (const auto cell = by_cell_.find(key); cell != by_cell_.end())
        for (std::uint32_t i = cell->second.first; i < cell->second.end; ++i) visit(places_[i]);
    });
  }
  /// Least `most_m` within `reach_m` of the square that holds p; large where there is no lane.
  double least_near_m(const Vec2& p) const;

  const std::vector<Place>& places() const { return places_; }

 private:
  static constexpr PlaneCells cells{8.0};
  static constexpr double reach_m = 16.0;
  struct Cell {
    std::uint32_t first = 0, end = 0;  ///< Range of places_.
    double least_m = 1e300;
  };

  std::vector<Place> places_;  ///< Sorted by cell.
  std::unordered_map<std::uint64_t, Cell> by_cell_;
  std::unordered_map<std::uint64_t, double> least_near_;
};

}  // namespace septet::roadside
