#pragma once
/// Records of crashes (engine/world/crash_record.hpp) in a log, and their words.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/world/crash_record.hpp"
#include "logging/session/participants.hpp"
#include "logging/session/records.hpp"

namespace septet::logging {

/// All that the events tell, by the time of their touch. Sessions of earlier builds have none.
std::vector<CrashRecord> find_crashes(std::span<const Event> events);

/// The record of the touch that an event `collision` or `crash_of_others` tells; empty: none was told of it.
std::optional<CrashRecord> crash_of(const Event& touch, std::span<const CrashRecord> crashes);

/// Whence a blow came: "from ahead", "from the left", "from behind, right", ….
std::string_view whence(double principal_direction_rad);

/// A record in a sentence: "participants 1 ego and 3 met at 49 km/h; 1 ego: ΔV 23 km/h, from ahead, crushed by 0.38 m;
/// 3: …". `names`: of the session.
std::string crash_text(const CrashRecord& crash, const ParticipantNames& names);

}  // namespace septet::logging
