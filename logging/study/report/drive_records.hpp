#pragma once
/// Data of a session that its measures are computed from.

#include <optional>
#include <vector>

#include "engine/core/expected.hpp"
#include "logging/session/records.hpp"
#include "logging/session/session_reader.hpp"
#include "logging/study/measures/glances.hpp"
#include "logging/study/report/impossible_numbers.hpp"

namespace septet::logging {

struct DriveRecords {
  std::vector<Sample> samples;
  std::vector<InputRecord> inputs;
  std::vector<Event> events;
  /// One per sample, for its lane; empty if no limit is posted or the road is unknown. Empty vector: all unknown.
  std::vector<std::optional<double>> speed_limits_mps;
  double ticks_per_second = 120.0;
  std::vector<GlanceArea> glance_areas;  ///< Areas of the session's rig; empty: unknown.
  std::optional<double> car_width_m;     ///< Width of the driven vehicle, without mirrors; empty: unknown.
  ImpossibleNumbers impossible;          ///< Rows left out of these.
};

Expected<DriveRecords> read_drive_records(const SessionReader& reader);

/// From the session's vehicle file; empty if it has none that can be read.
std::optional<double> car_width_of(const SessionInfo& info);

/// From the session's road. A session without a readable road has no limits.
std::vector<std::optional<double>> speed_limits_of(const SessionInfo& info, const std::vector<Sample>& samples);

}  // namespace septet::logging
