#include "engine/physics/impact/engagement.hpp"

#include <algorithm>
#include <utility>

#include "engine/physics/impact/restitution.hpp"

namespace septet::impact {
namespace {

constexpr double play_m = 0.002;  ///< Less of an overlap beyond the crush is left alone.
constexpr double joint_m = 0.1;   ///< More of it than this comes of no motion.

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

/// Crushes both along `way` by `depth_m` in all, each by its stiffness.
void crush(double depth_m, const Vec2& way, Side& first, Side& second) {
  if (!(depth_m > 0.0)) return;
  const CrushShares shares =
      crush_shares({first.body.mass_kg, first.crush}, {second.body.mass_kg, second.crush}, depth_m);
  cut_off(way, shares.first_m, first.outline);
  cut_off(-way, shares.second_m, second.outline);
}

/// The crush that an impact makes, beyond `overlap_m`.
void crush(const Impact& impact, double overlap_m, Side& first, Side& second) {
  crush(overlap_m + impact.pulse.most_depth_m, impact.pulse.normal, first, second);
  crush(impact.aside_m, impact.aside, first, second);
}

/// By how much crushed outlines overlap beyond the play, and where.
struct Excess {
  Place place;
  double overlap_m = 0.0;
};
std::optional<Excess> excess_of(const Side& first, const Side& second) {
  const auto contact = contact_of(first.outline, second.outline);
  if (!contact || -contact->gap_m <= play_m) return std::nullopt;
  return Excess{contact->place, -contact->gap_m - play_m};
}

/// The part of an excess that the last step's approach has made, as its time; the excess is what remains.
double time_within_s(double dt_s, const Side& first, const Side& second, Excess& excess) {
  const double closing_mps =
      glm::dot(relative_velocity_at(first.body, second.body, excess.place.point_m), excess.place.normal);
  if (!(closing_mps > 0.0)) return 0.0;
  const double time_s = std::min(dt_s, excess.overlap_m / closing_mps);
  excess.overlap_m = std::max(0.0, excess.overlap_m - closing_mps * time_s);
  return time_s;
}

/// The meeting again of bodies whose crushed outlines overlap, seen with all running pulses given.
std::optional<Impact> meet_again(double friction, const Engagement& engagement, const Due& due,
                                 const Due& due_to_second, const Excess& excess, double age_s, const Side& first,
                                 const Side& second) {
  Side own = first, other = second;
  for (const Pulse& pulse : engagement.pulses)
    exchange(pulse.impulse, 1.0 - share_at(pulse, pulse.age_s), own.body, other.body);
  give(due, own.body);
  give(due_to_second, other.body);
  Outline whole = first.outline, other_whole = second.outline;
  whole.cuts = other_whole.cuts = {};
  const double from_m = first.crushed_m + second.crushed_m + excess.overlap_m +
                        crush_along_m(engagement, whole, other_whole, excess.place.normal);
  return impact_at({excess.place, age_s}, own, other, friction, from_m);
}

void shift(Side& side, const Vec2& by_m) {
  side.body.mass_centre_m += by_m;
  side.outline.centre_m += by_m;
}

/// The part of an excess that no motion within the step explains (the next stretch of a wall), and so no push.
double sudden_m(double dt_s, const Side& first, const Side& second, const Excess& excess) {
  const Vec2 relative_mps = relative_velocity_at(first.body, second.body, excess.place.point_m);
  const double found_m = excess.overlap_m - glm::length(relative_mps) * dt_s;
  return found_m > joint_m ? found_m : 0.0;
}

/// Sets both apart, either by the other's share of the mass.
void set_apart(const Excess& excess, Engagement& engagement, Side& first, Side& second) {
  const double own = 1.0 / first.body.mass_kg, other = 1.0 / second.body.mass_kg;
  shift(first, -excess.overlap_m * own / (own + other) * excess.place.normal);
  shift(second, excess.overlap_m * other / (own + other) * excess.place.normal);
  engagement.set_apart_m += excess.overlap_m;
}

std::optional<Impact> first_meeting(double friction, double dt_s, Engagement& engagement, Side& first, Side& second,
                                    const Due& due, const Due& due_to_second) {
  auto impact = meet(first, second, friction, dt_s, due, due_to_second);
  if (!impact) {
    // Found in each other, or stopped by another contact's pulse: crushed so far.
    if (const auto excess = excess_of(first, second)) crush(excess->overlap_m, excess->place.normal, first, second);
    return std::nullopt;
  }
  Side a = moved_back(first, impact->touch.age_s), b = moved_back(second, impact->touch.age_s);
  crush(*impact, 0.0, a, b);
  first.outline.cuts = a.outline.cuts;
  second.outline.cuts = b.outline.cuts;
  engagement.pulses.push_back(impact->pulse);
  press(impact->touch.age_s, engagement.pulses.back(), engagement, first, second);
  return impact;
}

std::optional<Impact> go_on(double friction, double dt_s, Engagement& engagement, Side& first, Side& second,
                            const Due& due, const Due& due_to_second) {
  advance_pulses(dt_s, engagement, first, second);
  const auto excess = excess_of(first, second);
  if (!excess) return std::nullopt;
  Excess before = *excess;
  const double since_s = time_within_s(dt_s, first, second, before);
  auto again = meet_again(friction, engagement, due, due_to_second, before, since_s, first, second);
  if (again) {
    crush(*again, before.overlap_m, first, second);
    engagement.pulses.push_back(again->pulse);
    press(since_s, engagement.pulses.back(), engagement, first, second);
  } else if (due.runs || due_to_second.runs || !engagement.pulses.empty()) {
    crush(excess->overlap_m, excess->place.normal, first, second);
  }
  return again;
}

}  // namespace

Outline crushed(const Outline& outline, const Cuts& cuts) {
  Outline left = outline;
  left.cuts = cuts;
  return left;
}

double crushed_off_m(const Outline& whole, const Cuts& cuts, const Vec2& way) {
  return cuts.count == 0 ? 0.0 : reach_m(whole, way) - reach_m(crushed(whole, cuts), way);
}

double crush_along_m(const Engagement& engagement, const Outline& first, const Outline& second, const Vec2& normal) {
  return crushed_off_m(first, engagement.first, normal) + crushed_off_m(second, engagement.second, -normal);
}

void advance_pulses(double dt_s, Engagement& engagement, Side& first, Side& second) {
  for (Pulse& pulse : engagement.pulses) press(dt_s, pulse, engagement, first, second);
  std::erase_if(engagement.pulses, [](const Pulse& pulse) { return is_over(pulse); });
}

std::optional<Impact> advance_engagement(double friction, double dt_s, Engagement& engagement, Side& first,
                                         Side& second, const Due& due, const Due& due_to_second) {
  const bool fresh = engagement.pulses.empty() && engagement.first.count == 0 && engagement.second.count == 0;
  first.outline.cuts = engagement.first;
  second.outline.cuts = engagement.second;
  auto impact = fresh ? first_meeting(friction, dt_s, engagement, first, second, due, due_to_second)
                      : go_on(friction, dt_s, engagement, first, second, due, due_to_second);
  if (auto excess = excess_of(first, second)) {
    const double found_m = sudden_m(dt_s, first, second, *excess);
    crush(found_m, excess->place.normal, first, second);
    excess->overlap_m -= found_m;
    set_apart(*excess, engagement, first, second);
  }
  engagement.first = std::exchange(first.outline.cuts, {});
  engagement.second = std::exchange(second.outline.cuts, {});
  return impact;
}

bool is_over(const Engagement& engagement, const Outline& first, const Outline& second) {
  return engagement.pulses.empty() && !contact_of(first, second);
}

}  // namespace septet::impact
