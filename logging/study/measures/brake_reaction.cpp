#include "logging/study/measures/brake_reaction.hpp"

#include <algorithm>

namespace septet::logging {

NamedEvent parse_named_event(const std::string& text) {
  const auto colon = text.find(':');
  if (colon == std::string::npos) return {text, ""};
  return {text.substr(0, colon), text.substr(colon + 1)};
}

bool is_named(const Event& event, const NamedEvent& name) {
  return event.kind == name.kind && event.detail.find(name.detail_holds) != std::string::npos;
}

std::vector<BrakeReaction> find_brake_reactions(std::span<const Event> events, std::span<const InputRecord> inputs,
                                                double ticks_per_second, const NamedEvent& name,
                                                const BrakeReactionSettings& settings) {
  std::vector<BrakeReaction> reactions;
  for (const Event& event : events) {
    if (!is_named(event, name)) continue;
    BrakeReaction reaction{.onset_s = event.simulated_time_s};
    // The input of the event's own tick was given before anybody could see the event.
    auto input = std::ranges::lower_bound(inputs, event.tick, {}, &InputRecord::tick);
    if (input != inputs.end() && input->tick == event.tick && input->input.brake > settings.pressed) {
      reaction.response = BrakeResponse::braking_already;
      reactions.push_back(reaction);
      continue;
    }
    for (; input != inputs.end(); ++input) {
      const double time_s = static_cast<double>(input->tick - event.tick) / ticks_per_second;
      if (time_s > settings.longest_s) break;
      reaction.time_s = time_s;
      if (input->input.brake <= settings.pressed) continue;
      reaction.response = BrakeResponse::braked;
      break;
    }
    reactions.push_back(reaction);
  }
  return reactions;
}

}  // namespace septet::logging
