#pragma once
/// Time headway and time gap of the driver's following.
///
/// Headway is from front bumper to front bumper, gap from the driver's front bumper to the leader's rear bumper (SAE
/// J2944:2015, 8.1.4, common feature: the front bumper; Green 2012 on why the two are never mixed). Both are divided by
/// the driver's own speed. The driver follows while the headway is at most `longest_s`: J2944 asks for that cut-off.

#include <optional>
#include <span>

#include "logging/session/records.hpp"

namespace septet::logging {

struct FollowingSettings {
  double longest_s = 6.0;        ///< Time headway.
  double least_speed_mps = 1.0;  ///< Below it the headway is undefined.
  double close_s = 1.0;          ///< The share of following below this is reported.
};

/// For headway or gap, over the samples in which the driver follows.
struct FollowingStatistics {
  std::optional<double> smallest_s, median_s, mean_s;
  double close_share = 0.0;
};

struct FollowingMeasures {
  FollowingStatistics headway, gap;
  std::size_t samples = 0;    ///< Samples in which the driver follows.
  std::size_t no_leader = 0;  ///< Samples without a leader within 250 m in the lane, or off every lane.
  std::size_t farther = 0;    ///< Samples beyond the cut-off.
  std::size_t too_slow = 0;
};

FollowingMeasures compute_following(std::span<const Sample> samples, const FollowingSettings& settings = {});

}  // namespace septet::logging
