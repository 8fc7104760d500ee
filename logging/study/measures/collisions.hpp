#pragma once
/// Collisions of the driver's car, with their closing speeds.
///
/// From the log's events `collision` (FORMAT.md): one for each contact, with a vehicle, a person, an object or roadside
/// furniture, at its beginning. The closing speed is that of the event's detail; events without one are counted as
/// such. Where the log has a crash's record, what it came to stands beside it.

#include <optional>
#include <span>
#include <vector>

#include "engine/world/crash_record.hpp"
#include "logging/session/records.hpp"

namespace septet::logging {

struct Collision {
  double simulated_time_s = 0.0;
  std::optional<ParticipantId> other;  ///< Empty: roadside furniture.
  std::optional<double> closing_speed_mps;
  std::optional<CrashRecord> crash;  ///< The driver's car is its first body.
};

std::vector<Collision> find_collisions(std::span<const Event> events);

/// Number after "KEY=" in an event's detail.
std::optional<double> number_in_detail(const std::string& detail, const std::string& key);

}  // namespace septet::logging
