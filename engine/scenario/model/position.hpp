#pragma once
/// Positions as OpenSCENARIO XML 1.3 writes them, not yet looked up on a road (see resolve_position.hpp).

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/scenario/model/entity.hpp"

namespace septet::scenario {

/// Relative: to the lane's direction of travel or to the reference entity; absolute: to the world.
struct Orientation {
  bool given = false;  ///< True where the file has one.
  bool relative = true;
  double heading_rad = 0.0, pitch_rad = 0.0, roll_rad = 0.0;
};

struct WorldPosition {
  Vec3 position_m{0.0};
  std::optional<double> height_m;  ///< z where the file gives one, else the surface of the road.
  bool heading_given = false;      ///< Else the heading is 0.
  double heading_rad = 0.0, pitch_rad = 0.0, roll_rad = 0.0;
};

struct RelativeWorldPosition {
  EntityIndex entity = no_entity;
  Vec3 delta_m{0.0};  ///< In the world's axes.
  Orientation orientation;
};

struct RelativeObjectPosition {
  EntityIndex entity = no_entity;
  Vec3 delta_m{0.0};  ///< In the reference entity's axes.
  Orientation orientation;
};

struct RoadCoordinates {
  std::string road;
  double s_m = 0.0, t_m = 0.0;
  Orientation orientation;
};

struct RelativeRoadPosition {
  EntityIndex entity = no_entity;
  double ds_m = 0.0, dt_m = 0.0;
  Orientation orientation;
};

struct LaneCoordinates {
  std::string road;
  int lane = 0;
  double s_m = 0.0;
  double offset_m = 0.0;  ///< From the lane's centre, towards +t.
  Orientation orientation;
};

struct RelativeLanePosition {
  EntityIndex entity = no_entity;
  int lanes_to_the_left = 0;
  double ds_m = 0.0;
  bool along_lane = false;  ///< ds is measured along the lane (dsLane) in its direction of travel,
                            ///< else along the road's s.
  double offset_m = 0.0;
  Orientation orientation;
};

struct Route;

/// A place along a route: a distance from its first waypoint, in a lane, at a t of the road there, or at an entity.
struct RoutePosition {
  std::shared_ptr<const Route> route;
  double path_s_m = 0.0;
  std::optional<int> lane;
  double offset_m = 0.0;  ///< From the lane's centre, towards +t.
  std::optional<double> t_m;
  EntityIndex entity = no_entity;
  Orientation orientation;
};

/// Empty: the file used a kind that is not supported yet, which was reported when it was read.
using Position =
    std::variant<std::monostate, WorldPosition, RelativeWorldPosition, RelativeObjectPosition, RoadCoordinates,
                 RelativeRoadPosition, LaneCoordinates, RelativeLanePosition, RoutePosition>;

/// Waypoints in driving order, joined by the shortest path.
struct Route {
  std::vector<Position> waypoints;
  std::size_t index = 0;  ///< In Scenario::routes and ScenarioState::routes.
};

}  // namespace septet::scenario
