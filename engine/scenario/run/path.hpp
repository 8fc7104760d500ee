#pragma once
/// A trajectory laid out in the world: points to be followed by an entity.

#include <optional>
#include <vector>

#include "engine/road/road_network.hpp"
#include "engine/scenario/model/trajectory.hpp"
#include "engine/scenario/run/scenario_state.hpp"

namespace septet::scenario {

/// Point of the path at a station; between two points all values are linear.
struct PathPoint {
  double s_m = 0.0;  ///< From the path's start; two points at one station are a jump.
  Vec3 position_m{0.0};
  double heading_rad = 0.0;  ///< Not wrapped: it turns in the path's direction.
  double time_s = 0.0;
};
struct Path {
  std::vector<PathPoint> points;  ///< At least two, stations and times never falling.

  double length_m() const { return points.back().s_m; }
  double end_s() const { return points.back().time_s; }
};

/// Empty where a position of the trajectory has no place or the trajectory has no length. Positions are those of the
/// moment: one relative to an entity depends on its present place. A polyline's heading is that of its lines, turned
/// evenly within 2 m of a vertex, or goes evenly from vertex to vertex where these have orientations. A closed polyline
/// goes round once. A curve has at most 20,000 points, 0.1 m apart where that suffices.
std::optional<Path> lay_path(const road::RoadNetwork& network, const ScenarioState& state, const EntityState& actor,
                             const Trajectory& trajectory);

/// The point at a station, clamped to the path.
PathPoint path_at_station(const Path& path, double s_m);
/// The point at a time, clamped likewise.
PathPoint path_at_time(const Path& path, double time_s);

}  // namespace septet::scenario
