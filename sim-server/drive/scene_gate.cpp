#include "sim-server/drive/scene_gate.hpp"

#include <variant>

#include <fmt/core.h>

#include "engine/replication/message.hpp"
#include "engine/scene/inverse.hpp"

namespace septet::server {

std::optional<EditRefusal> pass_gate(scene::Store& store, std::span<const scene::Command> batch, scene::NodeId own_ids,
                                     const std::function<void(const scene::Command&)>& applied) {
  for (std::size_t i = 0; i < batch.size(); ++i) {
    const auto* create = std::get_if<scene::NodeCreate>(&batch[i]);
    if (!create) continue;
    if (own_ids == 0 || create->node < own_ids || create->node - own_ids >= replication::ids_per_session)
      return EditRefusal{i, fmt::format("node {} is not one of this editor's ids: use {} to {}", create->node, own_ids,
                                        own_ids + replication::ids_per_session - 1)};
  }
  const auto undo = scene::apply_whole(store, batch);
  if (!undo) return EditRefusal{undo.error().index, describe(undo.error().why)};
  for (const scene::Command& command : batch) applied(command);
  return std::nullopt;
}

}  // namespace septet::server
