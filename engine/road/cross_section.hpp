#pragma once
/// The cross-section of a road at one station, as a frame: the common step of forward and inverse map.

#include <cmath>

#include "engine/road/plan_curve.hpp"
#include "engine/road/road_network.hpp"

namespace septet::road {

struct CrossSection {
  PlanPoint plan;
  double z_m = 0.0;
  double grade = 0.0;  ///< dz/ds of the reference line.
  double roll_rad = 0.0;
  double sin_pitch = 0.0, cos_pitch = 1.0;
  double sin_roll = 0.0, cos_roll = 1.0;

  Vec2 left() const { return {-plan.direction.y, plan.direction.x}; }
  /// Rz·Ry·Rx applied to (0, t, h), set on the reference line.
  Vec3 place(double t_m, double h_m) const {
    const double lateral = t_m * cos_roll - h_m * sin_roll, up = t_m * sin_roll + h_m * cos_roll;
    const Vec2 xy = plan.position_m + sin_pitch * up * plan.direction + lateral * left();
    return {xy.x, xy.y, z_m + cos_pitch * up};
  }
};

inline CrossSection cross_section_at(const Road& road, double s_m) {
  CrossSection section;
  section.plan = evaluate_plan(road.plan, s_m);
  if (!road.elevation.empty()) {
    const CubicRecord& elevation = road.elevation[record_at(road.elevation, s_m)];
    section.z_m = elevation.value(s_m);
    section.grade = elevation.slope(s_m);
    section.cos_pitch = 1.0 / std::sqrt(1.0 + section.grade * section.grade);
    section.sin_pitch = -section.grade * section.cos_pitch;
  }
  section.roll_rad = value_at(road.superelevation, s_m);
  if (section.roll_rad != 0.0) {
    section.sin_roll = std::sin(section.roll_rad);
    section.cos_roll = std::cos(section.roll_rad);
  }
  return section;
}

}  // namespace septet::road
