#pragma once
/// Of a session's numbers what they stand for: whoever reads it later, by another build or in another language, has the names beside them.

#include <map>
#include <string>

#include "engine/simulation/model.hpp"

namespace septet::server {

/// Rows of the session's meta table, as JSON (logging/FORMAT.md): `vehicle_models`, and `participant_names` of the driver and of everybody
/// whom the scenario names.
std::map<std::string, std::string> who_is_who(const simulation::Model& model);

}  // namespace septet::server
