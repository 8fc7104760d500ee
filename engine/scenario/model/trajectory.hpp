#pragma once
/// Trajectories as OpenSCENARIO XML 1.3 writes them ("Trajectory", "Shape"), not yet laid on a road (see
/// engine/scenario/run/path.hpp). SI units.

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/scenario/model/position.hpp"

namespace septet::scenario {

/// Straight lines from vertex to vertex.
struct PolylineShape {
  struct Vertex {
    Position position;
    double time_s = 0.0;
  };
  std::vector<Vertex> vertices;
};

/// Curves whose curvature grows evenly along their length; a single clothoid is a spline of one.
struct ClothoidSplineShape {
  struct Segment {
    std::optional<Position> start;  ///< Absent: the end of the segment before, or the entity's place.
    double start_curvature_per_m = 0.0, end_curvature_per_m = 0.0;
    double length_m = 0.0;
    double heading_offset_rad = 0.0;  ///< Added at its start.
    double start_time_s = 0.0;
  };
  std::vector<Segment> segments;
  double end_time_s = 0.0;
};

/// A rational B-spline.
struct NurbsShape {
  struct ControlPoint {
    Position position;
    double weight = 1.0;
    double time_s = 0.0;
  };
  int order = 2;  ///< Degree + 1.
  std::vector<ControlPoint> points;
  std::vector<double> knots;  ///< As many as points and order together, never falling.
};

struct Trajectory {
  std::string name;
  bool closed = false;  ///< The last vertex is followed by the first.
  std::variant<PolylineShape, ClothoidSplineShape, NurbsShape> shape;
};

/// FollowTrajectoryAction.
struct FollowTrajectoryAction {
  Trajectory trajectory;
  double initial_distance_m = 0.0;  ///< Station at which the entity begins.
  /// With a time reference the trajectory's times give the place at each time, scaled and then shifted; without, the
  /// entity keeps its own speed.
  bool timed = false;
  bool from_simulation_start = false;  ///< Its times count from time 0, else from the action's start.
  double time_scale = 1.0, time_offset_s = 0.0;
};

}  // namespace septet::scenario
