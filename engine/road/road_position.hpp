#pragma once
/// Positions in a road network, and the world there: the forward map.
///
/// The point (0, t, height) in the road's cross-section is turned by roll, pitch and heading (Rz·Ry·Rx) and set on the
/// reference line, so that t is measured in the tilted plane (OpenDRIVE 1.8, §8 and §10). Positions outside a road are
/// clamped to its nearest end. Pure functions; safe from many threads.

#include "engine/math/rigid_transform.hpp"
#include "engine/road/road_network.hpp"

namespace septet::road {

struct RoadPosition {
  RoadIndex road = 0;
  double s_m = 0.0;  ///< Along the reference line.
  double t_m = 0.0;  ///< Offset to the left of it.
};

struct LanePosition {
  RoadIndex road = 0;
  int lane = 0;
  double s_m = 0.0;
  double offset_m = 0.0;  ///< From the centre of the lane, towards +t for every lane.
};

struct RoadPoint {
  Vec3 position_m{0.0, 0.0, 0.0};  ///< On the road's surface.
  double heading_rad = 0.0;        ///< Heading of the reference line towards increasing s, in (−π, π].
  double pitch_rad = 0.0;          ///< −atan(dz/ds): negative climbs.
  double roll_rad = 0.0;           ///< Positive lifts the left side.
  double curvature_per_m = 0.0;    ///< Curvature of the line of constant t through the point; positive turns left.
  /// Metres along the line of constant t per metre of s: 1 − κt.
  double stretch = 1.0;
};

struct LanePoint {
  RoadPoint road;
  double t_m = 0.0;
  double lane_width_m = 0.0;
  double lane_slope = 0.0;           ///< dt/ds of the lane's centre.
  double driving_heading_rad = 0.0;  ///< Tangent of the lane in its direction of travel, in (−π, π].
};

RoadPoint evaluate(const RoadNetwork& network, const RoadPosition& position);
/// Metres along the line of constant offset from the lane's middle per metre of s: by bend, widening and climb. At
/// least 0.05.
double lane_stretch(const LanePoint& point);
/// The lane must exist in the section at s (see lane_geometry.hpp); a missing one is replaced by the outermost on its
/// side.
LanePoint evaluate_lane(const RoadNetwork& network, const LanePosition& position);

/// Metres along the lane's middle (at `offset_m`) from the position to the station `to_s_m` of the same road; negative
/// towards lower s. Gaps and headways are measured so (SAE J2944: along the path of travel). Sampled every `step_m`; a
/// part of the road without the lane counts as its outermost one.
double length_along_lane_m(const RoadNetwork& network, const LanePosition& from, double to_s_m, double step_m = 10.0);

/// Pose at a point of the road: x along increasing s, y to the left, z off the surface.
RigidTransform world_from_road(const RoadPoint& point);
/// Pose at a point of a lane: x in the lane's direction of travel, z off the surface.
RigidTransform world_from_lane(const LanePoint& point);

/// An angle wrapped into (−π, π].
double wrap_angle(double angle_rad);

}  // namespace septet::road
