#pragma once
/// Words for the kinds of participants, in logs and tables.

#include <string_view>

#include "engine/world/vehicle_model.hpp"

namespace septet {

/// "car", "pedestrian", …
std::string_view name_of(ParticipantKind kind);

}  // namespace septet
