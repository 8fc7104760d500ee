#pragma once
/// Lowering of the corners of the land's grid, so that none of its squares lies over a lane.
///
/// Squares of the drawn land are wide (plants.hpp: land_cell_m); where roads lie on different levels beside one
/// another, or a road in a cut, their corners may lie right and the ground between them wrong.

#include <cstdint>
#include <functional>
#include <unordered_map>

#include "engine/roadside/lane_levels.hpp"

namespace septet::roadside {

class LoweredLand {
 public:
  LoweredLand() = default;
  /// `height_m`: height of the land before it is lowered.
  LoweredLand(const LaneLevels& lanes, const std::function<double(const Vec2&)>& height_m);

  /// Amount by which the land is lowered at p, bilinear between the corners, as the land is.
  double by_m(const Vec2& p) const;

 private:
  std::unordered_map<std::uint64_t, double> corners_m_;
};

}  // namespace septet::roadside
