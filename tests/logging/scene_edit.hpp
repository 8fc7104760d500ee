#pragma once
// A command of the scene as the log keeps it.

#include "engine/scene/command_codec.hpp"
#include "logging/session/records.hpp"

namespace septet::logging {

inline SceneEdit edit_of(Tick tick, const scene::Command& command) {
  SceneEdit edit{tick, {}};
  scene::encode(command, edit.command);
  return edit;
}

}  // namespace septet::logging
