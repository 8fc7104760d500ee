#pragma once
/// The scene of a session, from its scene edits.

#include "engine/scene/store.hpp"
#include "logging/session/session_reader.hpp"

namespace septet::logging {

/// Applies every edit to an empty store. Error: the file is damaged, or an edit is invalid.
Expected<void> restore_scene(const SessionReader& session, scene::Store& store);

}  // namespace septet::logging
