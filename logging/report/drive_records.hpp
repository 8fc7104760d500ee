#pragma once
/// Of a session what its measures are computed from.

#include <optional>
#include <vector>

#include "engine/core/expected.hpp"
#include "logging/measures/glances.hpp"
#include "logging/records.hpp"
#include "logging/report/impossible_numbers.hpp"
#include "logging/session_reader.hpp"

namespace septet::logging {

struct DriveRecords {
  std::vector<Sample> samples;
  std::vector<InputRecord> inputs;
  std::vector<Event> events;
  /// One for each sample, of the lane it is in; nothing where none is posted or the road is not known. Empty: of none is known.
  std::vector<std::optional<double>> speed_limits_mps;
  double ticks_per_second = 120.0;
  std::vector<GlanceArea> glance_areas;  ///< Of the rig that was sat in; empty: it is not known.
  std::optional<double> car_width_m;     ///< Of the vehicle that was driven, without mirrors; nothing: it is not known.
  ImpossibleNumbers impossible;          ///< What was left out of these.
};

Expected<DriveRecords> read_drive_records(const SessionReader& reader);

/// From the vehicle's file that the session holds; nothing where it holds none that can be read.
std::optional<double> car_width_of(const SessionInfo& info);

/// From the road that the session holds. A session without a road that can be read has no limits.
std::vector<std::optional<double>> speed_limits_of(const SessionInfo& info, const std::vector<Sample>& samples);

}  // namespace septet::logging
