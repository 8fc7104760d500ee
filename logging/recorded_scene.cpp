#include "logging/recorded_scene.hpp"

#include "engine/scene/command_codec.hpp"

namespace septet::logging {

Expected<void> restore_scene(const SessionReader& session, scene::Store& store) {
  const auto edits = session.scene_edits();
  if (!edits) return tl::unexpected(edits.error());
  for (const SceneEdit& edit : *edits) {
    const auto command = scene::decode(edit.command);
    if (!command) return tl::unexpected(command.error());
    if (auto applied = store.apply(*command); !applied) return applied;
  }
  return {};
}

}  // namespace septet::logging
