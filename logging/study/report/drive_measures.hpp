#pragma once
/// All measures of one drive, from its samples, inputs and events: for the report and the summary.

#include <optional>
#include <vector>

#include "logging/session/records.hpp"
#include "logging/study/measures/accelerations.hpp"
#include "logging/study/measures/brake_reaction.hpp"
#include "logging/study/measures/collisions.hpp"
#include "logging/study/measures/following.hpp"
#include "logging/study/measures/glances.hpp"
#include "logging/study/measures/hazard_reactions.hpp"
#include "logging/study/measures/lane_changes.hpp"
#include "logging/study/measures/lateral_position.hpp"
#include "logging/study/measures/speeding.hpp"
#include "logging/study/measures/steering_entropy.hpp"
#include "logging/study/measures/steering_reversals.hpp"
#include "logging/study/measures/time_to_collision.hpp"
#include "logging/study/measures/time_to_line_crossing.hpp"
#include "logging/study/report/drive_records.hpp"

namespace septet::logging {

/// Statistics of fewer samples (30 s) are not comparable, and are marked so.
inline constexpr std::size_t few_samples = 300;

struct MeasureSettings {
  LaneChangeSettings lane_changes;
  LateralPositionSettings lateral_position;
  GlanceSettings glances;
  FollowingSettings following;
  TtcSettings ttc;
  TlcSettings tlc;
  SpeedingSettings speeding;
  AccelerationSettings accelerations;
  ReversalSettings reversals_visual = visual_load_reversals, reversals_cognitive = cognitive_load_reversals;
  SteeringEntropySettings steering_entropy;
  std::optional<NamedEvent> braking_event;  ///< Event to brake for; without it there is no reaction time.
  BrakeReactionSettings brake_reaction;
  HazardReactionSettings hazard_reaction;
};

struct DriveMeasures {
  std::size_t samples = 0;
  ImpossibleNumbers impossible;  ///< Rows left out.
  double duration_s = 0.0;
  double distance_m = 0.0;                                                   ///< Speed summed over time (trapezoidal).
  double speed_mean_mps = 0.0, speed_sd_mps = 0.0, speed_largest_mps = 0.0;  ///< SD divides by N.
  LateralPositionStatistics lateral_position;
  LateralPositionHistogram histogram;
  std::vector<LaneChange> lane_changes;
  /// True if a lane was known at any sample: without one there are no lane changes.
  bool has_lanes() const { return histogram.total() > 0; }
  std::optional<double> between_lane_changes_s;
  std::vector<GlanceArea> glance_areas;  ///< Areas searched for glances.
  bool head_is_known = false;            ///< If false, glances are unknown.
  std::vector<Glance> glances;
  std::optional<double> between_glances_s;  ///< Duration over their number.
  FollowingMeasures following;
  TtcMeasures ttc;
  TlcMeasures tlc;
  SpeedingMeasures speeding;
  AccelerationMeasures accelerations;
  ReversalRate reversals_visual, reversals_cognitive;
  SteeringEntropy steering_entropy;
  std::vector<BrakeReaction> brake_reactions;
  std::vector<HazardReaction> hazard_reactions;
  std::vector<Collision> collisions;
};

DriveMeasures compute_drive_measures(const DriveRecords& records, const MeasureSettings& settings = {});

}  // namespace septet::logging
