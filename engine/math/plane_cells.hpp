#pragma once
/// Grid of squares in the plane, for look-ups near a place.

#include <cmath>
#include <cstdint>

#include "engine/math/rigid_transform.hpp"

namespace septet {

/// Grid of squares `cell_m` wide, each with a key for a hash table.
struct PlaneCells {
  double cell_m = 1.0;

  std::int64_t index_of(double metres) const { return static_cast<std::int64_t>(std::floor(metres / cell_m)); }
  static std::uint64_t key_of(std::int64_t x, std::int64_t y) {
    return static_cast<std::uint64_t>(x) << 32 ^ (static_cast<std::uint64_t>(y) & 0xffff'ffffu);
  }
  std::uint64_t key_at(const Vec2& p) const { return key_of(index_of(p.x), index_of(p.y)); }
  /// Calls `visit` with the key of every square that the box touches, row by row.
  template <class Visit>
  void for_each(const Vec2& low, const Vec2& high, const Visit& visit) const {
    for (std::int64_t y = index_of(low.y); y <= index_of(high.y); ++y)
      for (std::int64_t x = index_of(low.x); x <= index_of(high.x); ++x) visit(key_of(x, y));
  }
};

}  // namespace septet
