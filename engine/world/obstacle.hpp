#pragma once
/// Obstacles beside the road, as physics sees them in plan.
///
/// An obstacle is a line or a point with a radius: the stretch of a guard rail or wall between two posts, a trunk, a
/// leg. Lines follow one another in a run (one rail), so that a car sliding along it meets one obstacle and no joints.
/// World frame, metres.

#include <cstdint>
#include <string_view>

#include "engine/math/rigid_transform.hpp"

namespace septet {

enum class ObstacleKind : std::uint8_t {
  guard_rail,
  concrete_barrier,
  parapet,
  noise_wall,
  tunnel_wall,
  portal,
  gantry_leg,
  marker_post,
  tree,
  bush,
  house,
  post,         ///< Post of a sign, a traffic light or a lamp.
  ground_face,  ///< A step of the ground higher than a wheel climbs.
};

/// "guard rail", "tree", …: for the log.
std::string_view name_of(ObstacleKind kind);

struct Obstacle {
  ObstacleKind kind = ObstacleKind::tree;
  std::uint32_t run = 0;                  ///< Equal for parts of one object: all stretches of one rail.
  Vec2 from_m{0.0}, to_m{0.0};            ///< Equal: round.
  double radius_m = 0.1;                  ///< Half the thickness of a line.
  double low_m = 0.0, high_m = 0.0;       ///< World z.
  bool open_from = true, open_to = true;  ///< No obstacle continues straight at this end.
  double friction = 0.4;                  ///< Friction of a car's body that slides along it.
  double yielding_kg = 0.0;               ///< Mass of an obstacle that is knocked over; 0: it stands fast.
  std::uint32_t thing = 0;                ///< The one object of the scene that shows it; 0: it is drawn with others.
};

}  // namespace septet
