#pragma once
/// The hull and the obstacles that it may meet, as outlines in plan.

#include <cstddef>
#include <span>
#include <vector>

#include "engine/physics/impact/outline.hpp"
#include "engine/physics/vehicle/hull.hpp"

namespace septet::vehicle {

/// The hull during one step.
struct HullOutline {
  impact::Outline outline;
  double low_m = 0.0, high_m = 0.0;  ///< World z.
};
HullOutline hull_outline(const BodyParameters& body, const VehicleState& state);

/// The third along and across in which a place lies, as HullState::crush_m counts them.
std::size_t hull_zone(const impact::Outline& outline, const Vec2& place_m);

/// Of each run that overlaps the hull, the obstacle that does so deepest, in the order of `obstacles`.
struct Entered {
  const Obstacle* obstacle = nullptr;
  impact::Outline outline;
  double side = 1.0;  ///< Of a line: HullTouch::side.
};
std::vector<Entered> entered_obstacles(const HullOutline& hull, const Vec2& mass_centre_m,
                                       std::span<const Obstacle> obstacles, std::span<const HullTouch> touches);

}  // namespace septet::vehicle
