#pragma once
/// Lane keeping of the driver: mean and standard deviation of lateral position, and its histogram.
///
/// Reference point: the middle of the front axle, which the driver steers (SAE J2944:2015, 10.1.2, reference point 2).
/// Positive is to the driver's left. The standard deviation divides by N (the samples are the drive, not a draw from
/// it); the N−1 form stands beside it, since J2944 10.1.3 asks for the divisor.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "logging/session/records.hpp"
#include "logging/study/measures/lane_changes.hpp"

namespace septet::logging {

struct LateralPositionSettings {
  /// Samples nearer than this to a lane change's line crossing are left out: a lane change is no error of lane keeping.
  /// Zero keeps lane changes in.
  double exclude_around_lane_change_s = 3.0;
};

struct LateralPositionStatistics {
  double mean_m = 0.0;
  double sd_m = 0.0;         ///< Divides by N. Zero without samples, like the others.
  double sd_sample_m = 0.0;  ///< Divides by N − 1.
  std::size_t samples = 0;
  std::size_t excluded_lane_change = 0;
  std::size_t excluded_off_lane = 0;
};

LateralPositionStatistics compute_lateral_position_statistics(std::span<const Sample> samples,
                                                              std::span<const LaneChange> changes,
                                                              const LateralPositionSettings& settings = {});

/// Relative lateral position, offset over lane width, in 21 equal bins, closed below and open
/// above: bin i holds [edge(i), edge(i+1)) with edge(i) = −1/2 + i/21. Bin 0 begins at the
/// right-hand line, bin 10 has the lane's centre in its middle, bin 20 ends at the left-hand line.
struct LateralPositionHistogram {
  static constexpr std::size_t bins = 21;
  std::array<std::size_t, bins> counts{};
  std::size_t underflow = 0;  ///< Samples right of the lane.
  std::size_t overflow = 0;   ///< Samples on or left of the left-hand line.
  std::size_t off_lane = 0;   ///< Samples without lane, width or position.

  static constexpr double edge(std::size_t i) { return -0.5 + static_cast<double>(i) / bins; }
  /// All samples with a relative position, under- and overflow among them: the divisor of `fraction`.
  std::size_t total() const;
  double fraction(std::size_t bin) const;
};

/// Lane changes stay in, as in the paper's figure 5; their samples are the tails.
LateralPositionHistogram compute_lateral_position_histogram(std::span<const Sample> samples);

}  // namespace septet::logging
