#pragma once
/// Upright walls that hide what is behind them, found along a line of sight.
///
/// World frame, metres. Built once, then const and safe to read from many threads; the same walls in the same order give
/// the same answers.

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "engine/math/rigid_transform.hpp"

namespace septet::sight {

/// A thin wall in plan, opaque between two heights.
struct Wall {
  Vec2 from_m{0.0}, to_m{0.0};
  double low_m = 0.0, high_m = 0.0;  ///< World z.
  std::uint32_t thing = 0;           ///< The one object that it is a part of, which may be gone; 0: it always stands.
};

class Walls {
 public:
  Walls() = default;
  explicit Walls(std::vector<Wall> walls);

  /// True where a wall stands between two places, which are finite. `gone`: things without which it is, ascending.
  bool hide(const Vec3& eye_m, const Vec3& place_m, std::span<const std::uint32_t> gone = {}) const;

  bool empty() const { return walls_.empty(); }

 private:
  std::vector<Wall> walls_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;  ///< Ascending indices of walls.
};

}  // namespace septet::sight
