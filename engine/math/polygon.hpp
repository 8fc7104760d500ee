#pragma once
/// Polygons in the plane, as the corners of their outline; the last one is joined to the first.

#include <cstddef>
#include <vector>

#include <glm/vec2.hpp>

namespace septet {

/// True where p lies inside, by the even-odd rule. Corners are anything with x and y; a polygon without corners is
/// empty.
template <class Corner>
bool is_inside(const std::vector<Corner>& corners, const glm::dvec2& p) {
  bool inside = false;
  for (std::size_t i = 0, before = corners.size() - 1; i < corners.size(); before = i++) {
    const Corner &a = corners[i], &b = corners[before];
    if ((a.y > p.y) == (b.y > p.y)) continue;
    if (p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return inside;
}

}  // namespace septet
