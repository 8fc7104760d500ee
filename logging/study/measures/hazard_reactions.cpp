#include "logging/study/measures/hazard_reactions.hpp"

#include <algorithm>
#include <iterator>

#include "engine/world/hazard.hpp"

namespace septet::logging {
namespace {

/// Time from which on the hazard of an event can be seen.
std::optional<double> visible_from_s(std::span<const Event> events, const Event& begins, bool known) {
  if (known) return begins.simulated_time_s;
  for (const Event& event : events)
    if (event.kind == "first_sight" && event.participant == begins.participant && event.tick >= begins.tick)
      return event.simulated_time_s;
  return std::nullopt;
}

void find_response(std::span<const Sample> samples, const HazardReactionSettings& settings, HazardReaction& reaction) {
  auto at = std::ranges::upper_bound(samples, reaction.visible_s, {}, &Sample::simulated_time_s);
  if (at == samples.begin()) return;  // Nothing is known of the driver at that time.
  const Sample& before = *std::prev(at);
  if (before.speed_mps < settings.standing_mps) {
    reaction.response = HazardResponse::stood;
    return;
  }
  if (before.brake > settings.pressed) {
    reaction.response = HazardResponse::braking_already;
    return;
  }
  reaction.response = HazardResponse::censored;
  for (; at != samples.end(); ++at) {
    const double time_s = at->simulated_time_s - reaction.visible_s;
    if (time_s > settings.longest_s) break;
    reaction.time_s = time_s;
    const bool lifted = before.accelerator >= settings.held && at->accelerator <= 0.5 * before.accelerator;
    if (!lifted && at->brake <= settings.pressed) continue;
    reaction.response = at->brake > settings.pressed ? HazardResponse::braked : HazardResponse::lifted;
    break;
  }
}

}  // namespace

std::vector<HazardReaction> find_hazard_reactions(std::span<const Event> events, std::span<const Sample> samples,
                                                  const HazardReactionSettings& settings) {
  std::vector<HazardReaction> reactions;
  for (const Event& event : events) {
    const auto note = event.kind == hazard_event ? read_hazard_note(event.detail) : std::nullopt;
    if (!note) continue;
    HazardReaction reaction{.name = note->name, .who = event.participant, .begins_s = event.simulated_time_s};
    if (const auto visible_s = visible_from_s(events, event, note->known)) {
      reaction.visible_s = *visible_s;
      find_response(samples, settings, reaction);
    }
    const bool is_same =
        !reactions.empty() && reactions.back().name == reaction.name && reactions.back().begins_s == reaction.begins_s;
    if (!is_same)
      reactions.push_back(std::move(reaction));
    else if (reaction.counts() && (!reactions.back().counts() || reaction.visible_s < reactions.back().visible_s))
      reactions.back() = std::move(reaction);
  }
  return reactions;
}

}  // namespace septet::logging
