#pragma once
/// Participants of a session by number and by the name that its scenario gives them.

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/world/snapshot.hpp"
#include "engine/world/vehicle_model.hpp"
#include "logging/session/session_reader.hpp"

namespace septet::logging {

/// Names that the scenario gives, and those of the things in whose place solids stand, by number. Traffic has none.
using ParticipantNames = std::map<ParticipantId, std::string>;

/// Names of a session (meta row `participant_names`, and the commands that stand solids: FORMAT.md); of a solid's number
/// that several things had, the last one's. Who leaves a machine NAME is "NAME rider". Empty for one that keeps none. Error: an altered row, or damage.
Expected<ParticipantNames> participant_names(const SessionReader& session);

/// Number of a participant given as text: a name, or a number. Empty: neither.
std::optional<ParticipantId> number_of(const ParticipantNames& names, std::string_view text);

/// A participant's stay in a session.
struct Stay {
  ParticipantId number = 0;
  std::string name;  ///< Empty: it has none.
  ModelIndex model = 0;
  bool is_driver = false;
  double from_s = 0.0, to_s = 0.0;  ///< Simulated time of the first and the last tick that holds it.
};

/// How a person calls a participant: "4 crosser (saloon)"; without a name "17 (saloon)".
std::string called(const Stay& stay);
std::string called(const ParticipantNames& names, const Participant& participant);

/// "4 crosser"; without a name "17".
std::string called(const ParticipantNames& names, ParticipantId number);

/// All participants of a session, by number. Decodes the whole drive. Error: damage, or a session without snapshots.
Expected<std::vector<Stay>> stays_of(const SessionReader& session);

/// The participant with this name of the scenario or this number, or "driver". Error, at `where`: nobody at any time of
/// the session; the message names some of those there are.
Expected<Stay> find_stay(const SessionReader& session, std::string_view text, const std::string& where);

}  // namespace septet::logging
