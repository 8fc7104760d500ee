#include "logging/session/recorded_scene.hpp"

#include <fmt/core.h>

#include "engine/scene/command_codec.hpp"

namespace septet::logging {

Expected<void> restore_scene(const SessionReader& session, scene::Store& store) {
  const auto edits = session.scene_edits();
  if (!edits) return tl::unexpected(edits.error());
  std::size_t number = 1;
  for (const SceneEdit& edit : *edits) {
    const auto command = scene::decode(edit.command);
    auto applied = command ? store.apply(*command) : Expected<void>(tl::unexpected(command.error()));
    if (!applied)
      return failure(fmt::format("its scene is damaged, scene edit {}: {}", number, applied.error().what),
                     session.path().string(), "it was altered or damaged: use an unaltered copy");
    ++number;
  }
  return {};
}

}  // namespace septet::logging
