#pragma once
/// The crashes of a drive on its page: a table of each, its energies, and its pulse.

#include <span>
#include <string>

#include "engine/world/crash_record.hpp"
#include "logging/session/participants.hpp"

namespace septet::logging {

/// More crashes are counted and not shown.
inline constexpr std::size_t most_shown_crashes = 20;

/// Heading, tables and charts; empty without a crash. `names`: of the session.
std::string crash_section(std::span<const CrashRecord> crashes, double ticks_per_second, const ParticipantNames& names);

}  // namespace septet::logging
