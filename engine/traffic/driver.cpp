#include "engine/traffic/driver.hpp"

#include <algorithm>
#include <cmath>

#include "engine/sight/air.hpp"

namespace septet::traffic {
namespace {

/// Geometric interpolation of a factor: `timid` at 0, 1 at 0.5, `aggressive` at 1.
double factor(double timid, double aggressive, double temperament) {
  const double u = std::clamp(temperament, 0.0, 1.0);
  return u < 0.5 ? std::pow(timid, 1.0 - 2.0 * u) : std::pow(aggressive, 2.0 * u - 1.0);
}

}  // namespace

Driver with_temperament(const Driver& middle, double u) {
  Driver driver = middle;
  FollowingParameters& following = driver.following;
  following.desired_speed_mps *= factor(0.90, 1.15, u);
  following.time_gap_s *= factor(1.35, 0.62, u);
  following.acceleration_mps2 *= factor(0.65, 1.40, u);
  following.comfortable_braking_mps2 *= factor(0.65, 1.25, u);
  following.standstill_gap_m *= factor(1.40, 0.75, u);
  LaneChangeParameters& change = driver.lane_change;
  change.politeness *= factor(2.5, 0.05, u);
  change.threshold_mps2 *= factor(2.5, 0.5, u);
  change.largest_braking_mps2 *= factor(0.67, 1.7, u);
  driver.reaction_s *= factor(1.8, 0.6, u);
  return driver;
}

Driver with_worse_manners(const Driver& before) {
  Driver driver = before;
  driver.following.time_gap_s *= 0.94;
  LaneChangeParameters& change = driver.lane_change;
  change.politeness *= 0.6;
  change.threshold_mps2 *= 0.8;
  change.keep_right_mps2 *= 0.7;
  change.largest_braking_mps2 *= 1.12;
  driver.reaction_s *= 1.35;
  return driver;
}

FollowingLaw::FollowingLaw(const FollowingParameters& driver)
    : inverse_desired_speed(1.0 / driver.desired_speed_mps),
      time_gap_s(driver.time_gap_s),
      acceleration_mps2(driver.acceleration_mps2),
      standstill_gap_m(driver.standstill_gap_m),
      half_inverse_root_ab(0.5 / std::sqrt(driver.acceleration_mps2 * driver.comfortable_braking_mps2)),
      comfortable_braking_mps2(driver.comfortable_braking_mps2) {}

double acceleration_within_sight(const FollowingParameters& driver, double speed_mps, double seen_m) {
  constexpr double reaction_s = 1.0, settles_s = 1.0;
  const double braking_mps2 = driver.comfortable_braking_mps2;
  const double most_mps = sight::stopping_speed_mps(seen_m - driver.standstill_gap_m, reaction_s, braking_mps2);
  return std::max(-2.0 * braking_mps2, (most_mps - speed_mps) / settles_s);
}

double idm_equilibrium_speed(const FollowingParameters& driver, double gap_m) {
  const FollowingLaw law(driver);
  double low = 0.0, high = driver.desired_speed_mps;
  while (high - low > 1e-12) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (law.acceleration(middle, middle, gap_m) > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double idm_stability_margin(const FollowingParameters& driver, double gap_m) {
  const double v = idm_equilibrium_speed(driver, gap_m), a = driver.acceleration_mps2;
  const double v0 = driver.desired_speed_mps;
  const double wanted_over_gap = (driver.standstill_gap_m + v * driver.time_gap_s) / gap_m;
  const double by_gap = 2.0 * a * wanted_over_gap * wanted_over_gap / gap_m;
  const double by_speed =
      -a * (4.0 * v * v * v / (v0 * v0 * v0 * v0) + 2.0 * wanted_over_gap * driver.time_gap_s / gap_m);
  const double by_approach = -wanted_over_gap * v / gap_m * std::sqrt(a / driver.comfortable_braking_mps2);
  return (0.5 * by_speed + by_approach) * by_speed - by_gap;
}

}  // namespace septet::traffic
