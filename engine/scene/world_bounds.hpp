#pragma once
/// Bounds of places and sizes, beyond any world: what is larger is a mistake, and would become infinite in a picture's
/// floats. No command may have it, from wherever it comes (command_validation.hpp). Metres.

#include <cmath>

#include "engine/math/rigid_transform.hpp"

namespace septet::scene {

/// Distance of a place or vertex from the origin of its frame, along each axis: roads in projected coordinates reach 2e8 m
/// (engine/road/road_limits.hpp).
inline constexpr double farthest_m = 2.5e8;
/// Of a scale along each axis, in either direction.
inline constexpr double largest_scale = 1e4;
/// Of all scales from an object up to its root, multiplied: with more it is not drawn.
inline constexpr double largest_drawn_scale = 1e8;
/// Of the beginning of a motion's leg, in s of simulated time.
inline constexpr double latest_leg_s = 1e9;
/// Of a value of a geometry's layer: pictures' coordinates, normals, colours.
inline constexpr double largest_layer_value = 1e9;

/// False of what is not a number, too.
template <class Vector>
bool is_within(const Vector& v, double most) {
  return std::abs(v.x) <= most && std::abs(v.y) <= most && std::abs(v.z) <= most;
}
inline bool is_in_world(const Vec3& position_m) { return is_within(position_m, farthest_m); }

}  // namespace septet::scene
