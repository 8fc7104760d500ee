#pragma once
/// The sound of a drive, or of a session that is shown again, as the rig's [sound] asks for it.

#include <functional>
#include <memory>
#include <string>

#include "engine/rig/rig.hpp"
#include "engine/scene/store.hpp"
#include "engine/simulation/model.hpp"
#include "engine/world/taken_snapshot.hpp"
#include "logging/session_reader.hpp"

namespace septet::server {

/// Hands each tick, and how much of what shakes may do so (TickSource), to a thread that plays (host/live_sound.hpp). `model`: of the drive, or null; then `session` says which car and road it was. The
/// scene says where it echoes. `message`: is there a device, is it lost. `lost`: a device that was there plays no more.
std::function<void(const std::shared_ptr<const TakenSnapshot>&, double shaking_share)> drive_sound(
    const rig::Rig& rig, const std::shared_ptr<const simulation::Model>& model, const logging::SessionReader* session,
    const scene::Store& store, std::function<void(const std::string&)> message, std::function<void()> lost);

}  // namespace septet::server
