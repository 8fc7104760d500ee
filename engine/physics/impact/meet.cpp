#include "engine/physics/impact/meet.hpp"

#include <algorithm>
#include <cmath>

#include "engine/physics/impact/restitution.hpp"

namespace septet::impact {
namespace {

double gap_before_m(const Side& first, const Side& second, double time_s) {
  return nearest(moved_back(first, time_s).outline, moved_back(second, time_s).outline).gap_m;
}

/// Time before now at which the gap closed; it is open at `open_s` and closed at 0. False position with halved weights
/// (the Illinois rule): a few evaluations, and never out of the bracket.
double closing_time_s(const Side& first, const Side& second, double open_s, double open_m, double closed_m) {
  double closed_s = 0.0;
  int side = 0;
  for (int i = 0; i < 60; ++i) {
    const double time_s = (closed_s * open_m - open_s * closed_m) / (open_m - closed_m);
    const double gap_m = gap_before_m(first, second, time_s);
    if (std::abs(gap_m) < 1e-13) return time_s;
    if (gap_m > 0.0) {
      open_s = time_s;
      open_m = gap_m;
      if (side == 1) closed_m *= 0.5;
      side = 1;
    } else {
      closed_s = time_s;
      closed_m = gap_m;
      if (side == -1) open_m *= 0.5;
      side = -1;
    }
  }
  return closed_s;
}

/// Adds the motion of a body that stood before its share was given.
void add_motion(const Body& moved, Due& due) {
  due.velocity_mps += moved.velocity_mps;
  due.yaw_rate_radps += moved.yaw_rate_radps;
  due.runs = true;
}

}  // namespace

Side carried(const Side& side, const Body& body) {
  Side there = side;
  const double angle_rad = body.heading_rad - side.body.heading_rad;
  const Vec2 arm = side.outline.centre_m - side.body.mass_centre_m;
  there.body = body;
  there.outline.centre_m = body.mass_centre_m + (angle_rad == 0.0 ? arm : turned(arm, angle_rad));
  if (angle_rad != 0.0) there.outline.forward = turned(side.outline.forward, angle_rad);
  return there;
}

Side moved_back(const Side& side, double time_s) {
  Body before = side.body;
  before.mass_centre_m -= time_s * side.body.velocity_mps;
  before.heading_rad -= time_s * side.body.yaw_rate_radps;
  return carried(side, before);
}

std::optional<Touch> touch_of(const Side& first, const Side& second, double back_s) {
  const auto now = contact_of(first.outline, second.outline);
  if (!now) return std::nullopt;
  const double before_m = gap_before_m(first, second, back_s);
  if (!(before_m > 0.0) || !(now->gap_m < 0.0)) return Touch{now->place, 0.0};
  const double age_s = closing_time_s(first, second, back_s, before_m, now->gap_m);
  return Touch{nearest(moved_back(first, age_s).outline, moved_back(second, age_s).outline).place, age_s};
}

void add_due(const Pulse& pulse, const Body& first, Due& due) {
  Body own{first.mass_kg, first.yaw_inertia_kgm2}, other;
  exchange(pulse.impulse, 1.0 - share_at(pulse, pulse.age_s), own, other);
  add_motion(own, due);
}

void add_due_to_second(const Pulse& pulse, const Body& second, Due& due) {
  Body other, own{second.mass_kg, second.yaw_inertia_kgm2};
  exchange(pulse.impulse, 1.0 - share_at(pulse, pulse.age_s), other, own);
  add_motion(own, due);
}

void give(const Due& due, Body& body) {
  body.velocity_mps += due.velocity_mps;
  body.yaw_rate_radps += due.yaw_rate_radps;
}

std::optional<Impact> impact_at(const Touch& touch, const Side& first, const Side& second, double friction,
                                double from_m) {
  Place place = touch.place;
  const Vec2 relative_mps = relative_velocity_at(first.body, second.body, place.point_m);
  const double closing_mps = glm::dot(relative_mps, place.normal);
  if (!(closing_mps > 0.0)) return std::nullopt;
  CrushCurve curve = crush_curve({first.body.mass_kg, first.crush}, {second.body.mass_kg, second.crush});
  if (from_m > 0.0) curve = beyond(curve, from_m);
  Rule rule;
  rule.friction = friction;
  const Passing past = passing(first.outline, second.outline, relative_mps);
  const double needed_m = depth_m(curve, closing_mps);
  const bool scrapes = past.depth_m < needed_m;
  if (scrapes) rule.most_stopped_mps = speed_mps(curve, past.depth_m);
  place.point_m = engaged_point_m(first.outline, second.outline, place, std::min(past.depth_m, needed_m));
  rule.restitution = restitution(std::min(closing_mps, rule.most_stopped_mps));
  const auto impulse = impulse_at(first.body, second.body, place, rule);
  if (!impulse) return std::nullopt;
  return Impact{{place, touch.age_s},
                pulse_of(*impulse, place.normal, curve, rule.restitution),
                scrapes ? past.aside_m : 0.0,
                past.aside};
}

std::optional<Impact> meet(const Side& first, const Side& second, double friction, double back_s, const Due& due,
                           const Due& due_to_second) {
  if (!std::isfinite(first.body.mass_kg) && !std::isfinite(second.body.mass_kg)) return std::nullopt;
  const auto touch = touch_of(first, second, back_s);
  if (!touch) return std::nullopt;
  Side a = moved_back(first, touch->age_s), b = moved_back(second, touch->age_s);
  give(due, a.body);
  give(due_to_second, b.body);
  return impact_at(*touch, a, b, friction, first.crushed_m + second.crushed_m);
}

}  // namespace septet::impact
