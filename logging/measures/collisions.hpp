#pragma once
/// Collisions of the driver's car, with the speed at which it and the other closed in.
///
/// Out of the log's events `collision` (FORMAT.md): one for each contact, with a vehicle, a person, an object or what stands beside
/// the road, when it began. The closing speed is that of the event's detail; an event that says none is counted as such.

#include <optional>
#include <span>
#include <vector>

#include "logging/records.hpp"

namespace septet::logging {

struct Collision {
  double simulated_time_s = 0.0;
  std::optional<ParticipantId> other;  ///< Nothing: it stands beside the road.
  std::optional<double> closing_speed_mps;
};

std::vector<Collision> find_collisions(std::span<const Event> events);

/// The number behind "KEY=" in an event's detail.
std::optional<double> number_in_detail(const std::string& detail, const std::string& key);

}  // namespace septet::logging
