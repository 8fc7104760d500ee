#include "engine/physics/impact/engagement.hpp"

#include <algorithm>
#include <cmath>

#include "engine/physics/impact/restitution.hpp"

namespace septet::impact {
namespace {

constexpr double play_m = 0.002;  ///< Less of an overlap beyond the crush is left alone.

void press(double dt_s, Pulse& pulse, Engagement& engagement, Side& first, Side& second) {
  Body own = first.body, other = second.body;
  const Ledger before = pulse.ledger;
  engagement.given_ns += advance_pulse(dt_s, pulse, own, other);
  engagement.ledger.kinetic_j += pulse.ledger.kinetic_j - before.kinetic_j;
  engagement.ledger.crush_j += pulse.ledger.crush_j - before.crush_j;
  engagement.ledger.friction_j += pulse.ledger.friction_j - before.friction_j;
  first = carried(first, own);
  second = carried(second, other);
}

/// The meeting again of bodies that overlap by more than their crush, seen with all running pulses given.
std::optional<Impact> meet_again(double friction, const Engagement& engagement, const Side& first, const Side& second) {
  const auto contact = contact_of(first.outline, second.outline);
  if (!contact || -contact->gap_m <= engagement.crush_m + play_m) return std::nullopt;
  Body own = first.body, other = second.body;
  for (const Pulse& pulse : engagement.pulses) exchange(pulse.impulse, 1.0 - share_at(pulse, pulse.age_s), own, other);
  const Place& place = contact->place;
  const double closing_mps = glm::dot(relative_velocity_at(own, other, place.point_m), place.normal);
  const Rule rule{restitution(closing_mps), friction};
  const auto impulse = impulse_at(own, other, place, rule);
  if (!impulse) return std::nullopt;
  const CrushCurve curve =
      beyond(crush_curve({own.mass_kg, first.crush}, {other.mass_kg, second.crush}), -contact->gap_m);
  return Impact{{place, 0.0}, pulse_of(*impulse, place.normal, curve, rule.restitution)};
}

void shift(Side& side, const Vec2& by_m) {
  side.body.mass_centre_m += by_m;
  side.outline.centre_m += by_m;
}

/// Sets both apart where they overlap by more than their crush, either by the other's share of the mass.
void set_apart(Engagement& engagement, Side& first, Side& second) {
  const auto contact = contact_of(first.outline, second.outline);
  const double beyond_m = contact ? -contact->gap_m - engagement.crush_m - play_m : 0.0;
  if (!(beyond_m > 0.0)) return;
  const double own = 1.0 / first.body.mass_kg, other = 1.0 / second.body.mass_kg;
  shift(first, -beyond_m * own / (own + other) * contact->place.normal);
  shift(second, beyond_m * other / (own + other) * contact->place.normal);
  engagement.set_apart_m += beyond_m;
}

}  // namespace

std::optional<Impact> advance_engagement(double friction, double dt_s, Engagement& engagement, Side& first,
                                         Side& second) {
  if (engagement.pulses.empty() && engagement.crush_m == 0.0) {
    auto impact = meet(first, second, friction, dt_s);
    if (!impact) return std::nullopt;
    engagement.pulses.push_back(impact->pulse);
    engagement.crush_m = impact->pulse.most_depth_m;
    press(impact->touch.age_s, engagement.pulses.back(), engagement, first, second);
    return impact;
  }
  for (Pulse& pulse : engagement.pulses) press(dt_s, pulse, engagement, first, second);
  std::erase_if(engagement.pulses, [](const Pulse& pulse) { return is_over(pulse); });
  auto again = meet_again(friction, engagement, first, second);
  if (again) {
    const double from_m = -nearest(first.outline, second.outline).gap_m;
    engagement.pulses.push_back(again->pulse);
    engagement.crush_m = std::max(engagement.crush_m, from_m + again->pulse.most_depth_m);
  }
  set_apart(engagement, first, second);
  return again;
}

bool is_over(const Engagement& engagement, const Outline& first, const Outline& second) {
  return engagement.pulses.empty() && !contact_of(first, second);
}

}  // namespace septet::impact
