#pragma once
/// All measures of one drive, out of its samples and events: what the report prints and the summary
/// takes from.

#include <optional>
#include <span>
#include <vector>

#include "logging/measures/glances.hpp"
#include "logging/measures/lane_changes.hpp"
#include "logging/measures/lateral_position.hpp"
#include "logging/records.hpp"

namespace septet::logging {

/// Statistics of fewer samples (30 s) are no figure to compare with anything, and say so.
inline constexpr std::size_t few_samples = 300;

struct MeasureSettings {
  LaneChangeSettings lane_changes;
  LateralPositionSettings lateral_position;
  GlanceSettings glances;
  /// A driver follows while the time headway is at most this (SAE J2944 8.1.4 asks for the
  /// cut-off).
  double longest_following_headway_s = 6.0;
};

struct DriveMeasures {
  double duration_s = 0.0;
  double distance_m = 0.0;                                                   ///< Speed summed over time (trapezoidal).
  double speed_mean_mps = 0.0, speed_sd_mps = 0.0, speed_largest_mps = 0.0;  ///< SD divides by N.
  LateralPositionStatistics lateral_position;
  LateralPositionHistogram histogram;
  std::vector<LaneChange> lane_changes;
  std::optional<double> between_lane_changes_s;
  std::vector<Glance> glances;
  std::optional<double> between_glances_s;  ///< Duration over their number.
  std::optional<double> time_headway_median_s, time_headway_smallest_s;
  double following_s = 0.0;  ///< Time behind a leader within the cut-off, 0.1 s per sample.
};

DriveMeasures compute_drive_measures(std::span<const Sample> samples, const MeasureSettings& settings = {});

}  // namespace septet::logging
