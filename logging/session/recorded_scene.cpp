#include "logging/session/recorded_scene.hpp"

#include <limits>

#include <fmt/core.h>

#include "engine/scene/command_codec.hpp"

namespace septet::logging {

Expected<RecordedScene> RecordedScene::open(const SessionReader& session) {
  auto edits = session.scene_edits();
  if (!edits) return tl::unexpected(edits.error());
  return RecordedScene(std::move(*edits), session.path().string());
}

Expected<void> RecordedScene::advance(Tick tick, scene::Store& store,
                                      const std::function<void(const scene::Command&)>& applied) {
  for (; next_ < edits_.size() && edits_[next_].tick <= tick; ++next_) {
    const auto command = scene::decode(edits_[next_].command);
    const auto done = command ? store.apply(*command) : Expected<void>(tl::unexpected(command.error()));
    if (!done)
      return failure(fmt::format("its scene is damaged, scene edit {}: {}", next_ + 1, done.error().what), where_,
                     "it was altered or damaged: use an unaltered copy");
    if (applied) applied(*command);
  }
  return {};
}

Expected<void> restore_scene(const SessionReader& session, scene::Store& store) {
  auto scene = RecordedScene::open(session);
  if (!scene) return tl::unexpected(scene.error());
  return scene->advance(std::numeric_limits<Tick>::max(), store);
}

}  // namespace septet::logging
