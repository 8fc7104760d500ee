#include "engine/road/road_position.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/road/cross_section.hpp"
#include "engine/road/lane_geometry.hpp"
#include "engine/road/lane_links.hpp"

namespace septet::road {

double wrap_angle(double angle_rad) {
  constexpr double pi = std::numbers::pi;
  const double wrapped = std::remainder(angle_rad, 2.0 * pi);
  return wrapped <= -pi ? wrapped + 2.0 * pi : wrapped;
}

RoadPoint evaluate(const RoadNetwork& network, const RoadPosition& position) {
  const Road& road = network.roads[position.road];
  const double s = std::clamp(position.s_m, 0.0, road.length_m);
  const CrossSection section = cross_section_at(road, s);
  const double curvature = section.plan.curvature_per_m;
  RoadPoint point;
  point.position_m = section.place(position.t_m, surface_offset_m(road, s, position.t_m));
  point.heading_rad = std::atan2(section.plan.direction.y, section.plan.direction.x);
  point.pitch_rad = 0.0 - std::atan(section.grade);  // Never -0.
  point.roll_rad = section.roll_rad;
  point.stretch = 1.0 - curvature * position.t_m;
  point.curvature_per_m = curvature / point.stretch;
  return point;
}

LanePoint evaluate_lane(const RoadNetwork& network, const LanePosition& position) {
  const Road& road = network.roads[position.road];
  const double s = std::clamp(position.s_m, 0.0, road.length_m);
  const LaneSection& section = section_at(road, s);
  const int lane = std::clamp(position.lane, -section.right_count, section.left_count);
  const LaneBorders borders = lane_borders(road, section, lane, s);
  LanePoint point;
  point.t_m = borders.centre_t_m() + position.offset_m;
  point.lane_width_m = borders.width_m();
  point.lane_slope = borders.centre_slope();
  point.road = evaluate(network, {position.road, s, point.t_m});
  const double tangent = point.road.heading_rad + std::atan2(point.lane_slope, point.road.stretch);
  point.driving_heading_rad = wrap_angle(runs_along_s(road, section, lane) ? tangent : tangent + std::numbers::pi);
  return point;
}

double lane_stretch(const LanePoint& point) {
  const double grade = std::tan(point.road.pitch_rad);
  return std::max(0.05, std::hypot(point.road.stretch, point.lane_slope, grade));
}

double length_along_lane_m(const RoadNetwork& network, const LanePosition& from, double to_s_m, double step_m) {
  const auto stretch_at = [&](double s) {
    LanePosition there = from;
    there.s_m = s;
    return lane_stretch(evaluate_lane(network, there));
  };
  // Simpson's rule.
  const double way = to_s_m - from.s_m;
  const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(way) / step_m)));
  const double step = way / steps;
  double sum = 0.0, begin = stretch_at(from.s_m);
  for (int k = 0; k < steps; ++k) {
    const double end = stretch_at(from.s_m + (k + 1) * step);
    sum += begin + 4.0 * stretch_at(from.s_m + (k + 0.5) * step) + end;
    begin = end;
  }
  return sum * step / 6.0;
}

RigidTransform world_from_road(const RoadPoint& point) {
  return {point.position_m, orientation_from_angles(point.heading_rad, point.pitch_rad, point.roll_rad)};
}

RigidTransform world_from_lane(const LanePoint& point) {
  const Quat road = orientation_from_angles(point.road.heading_rad, point.road.pitch_rad, point.road.roll_rad);
  const double turn = point.driving_heading_rad - point.road.heading_rad;
  return {point.road.position_m, road * glm::angleAxis(turn, Vec3(0, 0, 1))};
}

}  // namespace septet::road
