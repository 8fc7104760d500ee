#pragma once
/// SpeedProfileAction (OpenSCENARIO XML 1.2) as a curve of speed over time, made when the action starts.
///
/// followingMode "position": straight from speed to speed. "follow": each of them with bounded change of acceleration,
/// which is 0 at every speed of the profile. A change that its time is too short for takes as long as the bounds
/// demand. Pure functions.

#include <vector>

#include "engine/scenario/model/action.hpp"

namespace septet::scenario {

struct SpeedProfile {
  /// The change of acceleration is constant in each part; one without duration is a jump.
  struct Phase {
    double start_s = 0.0;  ///< From the profile's start.
    double speed_mps = 0.0, acceleration_mps2 = 0.0, jerk_mps3 = 0.0;
  };
  std::vector<Phase> phases;
  double end_s = 0.0, end_mps = 0.0;
};

/// Profile from a speed through the entries of the action, all against the reference's speed if it has one.
SpeedProfile lay_speed_profile(const SpeedProfileAction& action, double from_mps, const DynamicConstraints& limits);
double speed_at(const SpeedProfile& profile, double time_s);

}  // namespace septet::scenario
