#pragma once
/// Vectors in a plane: x right, y up, angles counter-clockwise.

#include <cmath>

#include "engine/math/rigid_transform.hpp"

namespace septet {

/// z component of the cross product; positive where `b` points to the left of `a`.
inline double cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }

/// The vector turned by a right angle.
inline Vec2 left_of(const Vec2& v) { return {-v.y, v.x}; }

inline Vec2 turned(const Vec2& v, double angle_rad) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  return {c * v.x - s * v.y, s * v.x + c * v.y};
}

}  // namespace septet
