#include "engine/scenario/run/speed_profile.hpp"

#include <algorithm>
#include <cmath>

namespace septet::scenario {
namespace {

/// Time of an acceleration's rise to its peak and its fall, per m/s² of the peak; 0 where its change is unbounded.
double rise_s_per_mps2(double rise_mps3, double fall_mps3) { return 1.0 / rise_mps3 + 1.0 / fall_mps3; }

struct LayProfile {
  SpeedProfile profile;
  double speed_mps;

  void add(double duration_s, double acceleration_mps2, double jerk_mps3) {
    if (duration_s <= 0.0) return;
    profile.phases.push_back({profile.end_s, speed_mps, acceleration_mps2, jerk_mps3});
    profile.end_s += duration_s;
    speed_mps += duration_s * (acceleration_mps2 + 0.5 * jerk_mps3 * duration_s);
  }

  /// Goes to a speed in a time, or as soon as possible: the acceleration rises, stays and falls again (a trapezoid).
  void go_to(double target_mps, double time_s, const DynamicConstraints& limits, bool smooth) {
    const double change = std::abs(target_mps - speed_mps);
    const double sign = target_mps >= speed_mps ? 1.0 : -1.0;
    const double most = sign > 0.0 ? limits.max_acceleration_mps2 : limits.max_deceleration_mps2;
    // Slowing down, the deceleration's rate rises first.
    const double rise = sign > 0.0 ? limits.max_acceleration_rate_mps3 : limits.max_deceleration_rate_mps3;
    const double fall = sign > 0.0 ? limits.max_deceleration_rate_mps3 : limits.max_acceleration_rate_mps3;
    const double rises = smooth ? rise_s_per_mps2(rise, fall) : 0.0;
    // change = a · (time − a · rises / 2)
    double time = std::max(time_s, std::sqrt(2.0 * change * rises));
    const double root = std::sqrt(std::max(0.0, time * time - 2.0 * rises * change));
    double highest = change > 0.0 ? 2.0 * change / (time + root) : 0.0;  // Infinite: a jump.
    if (highest > most) {
      time = change / most + 0.5 * most * rises;
      highest = most;
    }
    if (std::isfinite(highest)) {
      const double up = smooth ? highest / rise : 0.0, down = smooth ? highest / fall : 0.0;
      add(up, 0.0, smooth ? sign * rise : 0.0);
      add(time - up - down, sign * highest, 0.0);
      add(down, sign * highest, smooth ? -sign * fall : 0.0);
    }
    speed_mps = target_mps;
  }
};

}  // namespace

SpeedProfile lay_speed_profile(const SpeedProfileAction& action, double from_mps, const DynamicConstraints& limits) {
  LayProfile lay{{}, from_mps};
  for (const SpeedProfileAction::Entry& entry : action.entries) {
    const double target = std::clamp(entry.speed_mps, -limits.max_speed_mps, limits.max_speed_mps);
    lay.go_to(target, entry.time_s.value_or(0.0), limits, action.smooth);
  }
  lay.profile.end_mps = lay.speed_mps;
  return std::move(lay.profile);
}

double speed_at(const SpeedProfile& profile, double time_s) {
  if (time_s >= profile.end_s || profile.phases.empty()) return profile.end_mps;
  const auto after =
      std::upper_bound(profile.phases.begin(), profile.phases.end(), time_s,
                       [](double time, const SpeedProfile::Phase& phase) { return time < phase.start_s; });
  const SpeedProfile::Phase& phase = after == profile.phases.begin() ? *after : *(after - 1);
  const double t = std::max(0.0, time_s - phase.start_s);
  return phase.speed_mps + t * (phase.acceleration_mps2 + 0.5 * phase.jerk_mps3 * t);
}

}  // namespace septet::scenario
