#pragma once
/// Records of the log beyond the snapshots: ten samples a second, and the events that follow from them. One call per
/// tick, on the thread that steps the simulation.

#include <cstdint>
#include <optional>
#include <vector>

#include "logging/session/records.hpp"
#include "logging/study/measures/glances.hpp"
#include "logging/study/measures/lane_changes.hpp"

namespace septet::logging {

/// State carried from tick to tick.
struct DriveObserver {
  double ticks_per_second = 120.0;
  LaneChangeDetector lane_changes = {};
  GlanceDetector glances = {};
};

struct Observation {
  std::optional<Sample> sample;
  std::vector<Event> events;  ///< lane_change, mirror_glance.
};

Observation observe(DriveObserver& observer, const Snapshot& snapshot, const std::optional<Leader>& leader);

}  // namespace septet::logging
