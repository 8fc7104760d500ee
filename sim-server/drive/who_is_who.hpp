#pragma once
/// Names for a session's numeric ids, so that later builds and other languages can resolve them.

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "engine/simulation/model.hpp"

namespace septet::server {

/// Of the driver and of the scenario's entities, in their order.
std::vector<std::pair<ParticipantId, std::string>> participant_names(const simulation::Model& model);

/// Rows of the session's meta table, as JSON (logging/FORMAT.md): `vehicle_models`, and `participant_names` of the
/// driver and of the scenario's entities.
std::map<std::string, std::string> who_is_who(const simulation::Model& model);

}  // namespace septet::server
