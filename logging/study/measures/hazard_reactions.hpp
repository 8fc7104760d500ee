#pragma once
/// Hazard perception: from the first moment at which the driver could see a hazard to his first reaction.
///
/// A hazard begins with the event `hazard` (engine/world/hazard.hpp). It can be seen from then on if it was known as it
/// began, else from the first `first_sight` of its participant after that. The reaction is the first sample with the brake pedal
/// beyond `pressed`, or with half of the accelerator given back that was down when it could be seen (a pedal that was down by less
/// than `held` tells nothing). One who braked already has reacted at once; one who stood, and a hazard that never came into
/// sight, have no reaction time. One who did not react within `longest_s` is censored: a lower bound. Resolution: a sample, 0.1 s.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "logging/session/records.hpp"

namespace septet::logging {

struct HazardReactionSettings {
  double pressed = 0.02;  ///< Share of the pedal's travel; the brake lamps' threshold.
  double held = 0.1;      ///< Share of the accelerator's travel.
  double standing_mps = 0.5;
  double longest_s = 10.0;
};

enum class HazardResponse { braked, lifted, braking_already, censored, stood, unseen };

struct HazardReaction {
  std::string name;
  std::optional<ParticipantId> who;  ///< Empty: fog, ice.
  double begins_s = 0.0;
  double visible_s = 0.0;  ///< Not for `unseen`.
  HazardResponse response = HazardResponse::unseen;
  double time_s = 0.0;  ///< From visible_s on: of the reaction, or without one.

  bool counts() const { return response != HazardResponse::stood && response != HazardResponse::unseen; }
};

/// One a hazard, however many its actors: of those, the one seen first. In the order of their beginnings.
std::vector<HazardReaction> find_hazard_reactions(std::span<const Event> events, std::span<const Sample> samples,
                                                  const HazardReactionSettings& settings = {});

}  // namespace septet::logging
