#pragma once
/// Random pairs of bodies that meet, from a seed.

#include <numbers>

#include "engine/core/random.hpp"
#include "engine/physics/impact/impulse.hpp"
#include "tests/engine/physics/impact/pairs.hpp"

namespace septet::impact {

struct RandomImpact {
  Body first, second;
  Place place;
  Rule rule;
};

inline Body random_body(Random& random, bool may_stand) {
  if (may_stand && random.uniform() < 0.2) return {};
  Body body;
  body.mass_kg = std::exp(random.uniform(std::log(5.0), std::log(40000.0)));
  const Vec2 arm_m(random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0));
  body.yaw_inertia_kgm2 = body.mass_kg * random.uniform(0.3, 6.0);
  body.mass_centre_m = -arm_m;
  body.velocity_mps = polar(random.uniform(0.0, 60.0), random.uniform(0.0, 360.0));
  body.yaw_rate_radps = random.uniform(-3.0, 3.0);
  return body;
}

/// An impact of two bodies whose surfaces approach, at the world's origin.
inline RandomImpact random_impact(Random& random) {
  for (;;) {
    RandomImpact impact;
    impact.first = random_body(random, false);
    impact.second = random_body(random, true);
    const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    impact.place.normal = Vec2(std::cos(angle), std::sin(angle));
    impact.rule = {random.uniform(0.0, 0.6), random.uniform(0.0, 1.2)};
    if (random.uniform() < 0.2) impact.rule.most_stopped_mps = random.uniform(0.1, 10.0);
    if (impulse_at(impact.first, impact.second, impact.place, impact.rule)) return impact;
  }
}

}  // namespace septet::impact
