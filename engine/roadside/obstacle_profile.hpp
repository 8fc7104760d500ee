#pragma once
/// Sizes and contact properties of obstacles beside a road, one row a kind: the scenery draws them, cars run against
/// them, and bodies are dented at their height.

#include "engine/roadside/signals.hpp"
#include "engine/roadside/tunnel_shape.hpp"
#include "engine/world/obstacle.hpp"

namespace septet::roadside {

/// Height of an obstacle that stands on the land and reaches above every vehicle.
inline constexpr double endless_m = 1e6;

struct ObstacleProfile {
  double radius_m;  ///< Half the thickness of a line.
  double height_m;  ///< Height over the ground at its foot.
  /// Coefficient for painted sheet metal sliding along it; chosen: 0.3 on steel, 0.45 on concrete and bark.
  double friction;
  double yielding_kg;  ///< Same as Obstacle::yielding_kg.
  /// Height over its foot up to which it hides what is behind; 0 for what is thin, low or looked through.
  double hides_m = 0.0;
};

constexpr ObstacleProfile profile_of(ObstacleKind kind) {
  switch (kind) {
    case ObstacleKind::guard_rail:
      return {0.08, 0.75, 0.30, 0.0};
    case ObstacleKind::concrete_barrier:
      return {0.20, 0.90, 0.45, 0.0};
    case ObstacleKind::parapet:
      return {0.16, 1.20, 0.35, 0.0};
    case ObstacleKind::noise_wall:
      return {0.16, 3.60, 0.45, 0.0, 3.60};
    case ObstacleKind::tunnel_wall:
      return {0.05, tunnel_shape::haunch_m, 0.45, 0.0, tunnel_shape::haunch_m};
    case ObstacleKind::portal:
      return {0.45, 9.0, 0.45, 0.0, 9.0};
    case ObstacleKind::gantry_leg:
      return {0.28, 8.0, 0.30, 0.0};
    case ObstacleKind::marker_post:
      return {0.06, 1.05, 0.20, 3.0};  // Plastic tube.
    case ObstacleKind::tree:
      return {0.20, endless_m, 0.45, 0.0};
    case ObstacleKind::bush:
      return {0.80, endless_m, 0.20, 40.0};
    case ObstacleKind::house:
      return {0.05, endless_m, 0.45, 0.0, endless_m};
    case ObstacleKind::post:
      return {signal_post_radius_m, 4.0, 0.30, 0.0};
    case ObstacleKind::ground_face:
      return {0.0, 0.0, 0.45, 0.0};  // Height is found during the drive (simulation/ground_faces.hpp).
  }
  return {0.1, 1.0, 0.4, 0.0};
}

}  // namespace septet::roadside
