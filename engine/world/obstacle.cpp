#include "engine/world/obstacle.hpp"

namespace septet {

std::string_view name_of(ObstacleKind kind) {
  switch (kind) {
    case ObstacleKind::guard_rail:
      return "guard rail";
    case ObstacleKind::concrete_barrier:
      return "concrete barrier";
    case ObstacleKind::parapet:
      return "parapet";
    case ObstacleKind::noise_wall:
      return "noise wall";
    case ObstacleKind::tunnel_wall:
      return "tunnel wall";
    case ObstacleKind::portal:
      return "tunnel portal";
    case ObstacleKind::gantry_leg:
      return "gantry leg";
    case ObstacleKind::marker_post:
      return "marker post";
    case ObstacleKind::tree:
      return "tree";
    case ObstacleKind::bush:
      return "bush";
    case ObstacleKind::house:
      return "house";
    case ObstacleKind::post:
      return "post";
    case ObstacleKind::ground_face:
      return "step of the ground";
  }
  return "";
}

}  // namespace septet
