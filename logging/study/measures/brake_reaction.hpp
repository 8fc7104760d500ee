#pragma once
/// Brake reaction time: from a named event to the first press of the brake pedal after it.
///
/// SAE J2944:2015, 6.5.2: from the event's onset to the first observable response. The event is named by its kind and
/// by a part of its detail ("scenario" with "lead brakes"); the response is the pedal beyond `pressed`. A driver who
/// presses it at the onset already has no reaction time. One who has not within `longest_s`, or before the log ends, is
/// censored: a lower bound, neither a missing value nor part of an average. Resolution: a tick (1/120 s).

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "logging/session/records.hpp"

namespace septet::logging {

struct NamedEvent {
  std::string kind;
  std::string detail_holds;  ///< Empty: any detail.
};
/// "KIND" or "KIND:PART OF THE DETAIL".
NamedEvent parse_named_event(const std::string& text);
bool is_named(const Event& event, const NamedEvent& name);

struct BrakeReactionSettings {
  double pressed = 0.02;  ///< Share of the pedal's travel; the brake lamps' threshold.
  double longest_s = 10.0;
};

enum class BrakeResponse { braked, braking_already, censored };

struct BrakeReaction {
  double onset_s = 0.0;
  BrakeResponse response = BrakeResponse::censored;
  double time_s = 0.0;  ///< Reaction time, or the time without one; 0 for a driver who braked already.
};

std::vector<BrakeReaction> find_brake_reactions(std::span<const Event> events, std::span<const InputRecord> inputs,
                                                double ticks_per_second, const NamedEvent& name,
                                                const BrakeReactionSettings& settings = {});

}  // namespace septet::logging
