#pragma once
/// The same bodies in a world that is turned about its origin, then shifted.

#include "engine/math/plane_vector.hpp"
#include "engine/physics/impact/meet.hpp"

namespace septet::impact {

inline Body in_moved_world(Body body, double angle, const Vec2& by) {
  body.mass_centre_m = turned(body.mass_centre_m, angle) + by;
  body.velocity_mps = turned(body.velocity_mps, angle);
  return body;
}

inline Outline in_moved_world(Outline outline, double angle, const Vec2& by) {
  outline.centre_m = turned(outline.centre_m, angle) + by;
  outline.forward = turned(outline.forward, angle);
  return outline;
}

inline Side in_moved_world(Side side, double angle, const Vec2& by) {
  side.body = in_moved_world(side.body, angle, by);
  side.outline = in_moved_world(side.outline, angle, by);
  return side;
}

}  // namespace septet::impact
