#pragma once
/// Two bodies that move freely in plan until they meet, and through the pulse that they exchange.

#include <algorithm>
#include <numbers>
#include <optional>

#include "engine/physics/impact/engagement.hpp"
#include "engine/physics/impact/restitution.hpp"
#include "tests/engine/physics/impact/pairs.hpp"

namespace septet::impact {

/// A car of usual size: 4.5 m by 1.8 m, its mass centre in the middle.
inline Side car_at(const Vec2& place_m, double heading_deg, const Vec2& velocity_mps, double mass_kg = 1500.0) {
  Side side;
  side.body = {mass_kg, mass_kg * 5.0 / 3.0, place_m, velocity_mps, 0.0};
  side.outline = box_outline(place_m, polar(1.0, heading_deg), {2.25, 0.9}, vehicle_corner_m());
  side.crush = passenger_car_crush();
  return side;
}

inline Side wall_from(const Vec2& from_m, const Vec2& to_m, double radius_m = 0.1) {
  Side side;
  side.outline = wall_outline(from_m, to_m, radius_m);
  return side;
}

inline Side moved(const Side& side, double dt_s) { return moved_back(side, -dt_s); }

struct Encounter {
  Side first, second;
  Engagement engagement;
  std::optional<Impact> impact;  ///< The first.
  int again = 0;                 ///< Further ones.
  double most_overlap_m = 0.0;   ///< Of the outlines as they lie.
  double most_beyond_m = -1.0;   ///< Overlap of the outlines less what is crushed off them.
};

/// Moves both in steps of `dt_s` for `time_s`; there is no ground.
inline Encounter encounter(const Side& first, const Side& second, double dt_s, double friction = vehicle_friction(),
                           double time_s = 2.0) {
  Encounter met{first, second};
  for (double t_s = 0.0; t_s < time_s; t_s += dt_s) {
    met.first = moved(met.first, dt_s);
    met.second = moved(met.second, dt_s);
    const auto begun = advance_engagement(friction, dt_s, met.engagement, met.first, met.second);
    if (begun && met.impact) ++met.again;
    if (begun && !met.impact) met.impact = begun;
    if (!met.impact) continue;
    const double overlap_m = -nearest(met.first.outline, met.second.outline).gap_m;
    met.most_overlap_m = std::max(met.most_overlap_m, overlap_m);
    const Meeting left =
        nearest(crushed(met.first.outline, met.engagement.first), crushed(met.second.outline, met.engagement.second));
    met.most_beyond_m = std::max(met.most_beyond_m, -left.gap_m);
    if (is_over(met.engagement, met.first.outline, met.second.outline)) break;
  }
  return met;
}

}  // namespace septet::impact
