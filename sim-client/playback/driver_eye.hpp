#pragma once
/// The rig of a recorded drive, and the place of the driver's eyes in it.

#include <optional>

#include "engine/rig/rig.hpp"
#include "logging/session/records.hpp"

namespace septet::playback {

/// Rig that a session keeps; empty: it keeps none that can be read.
std::optional<rig::Rig> rig_of(const logging::SessionInfo& info);

/// Eye point of the driver at rest, vehicle frame, from the session's rig; without one that of the model.
Vec3 driver_eye_m(const logging::SessionInfo& info);

}  // namespace septet::playback
