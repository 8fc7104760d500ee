#include "sim-server/drive/scene_gate.hpp"

#include <variant>

#include "engine/scene/inverse.hpp"
#include "sim-server/drive/edit_rights.hpp"

namespace septet::server {

std::optional<EditRefusal> pass_gate(scene::Store& store, std::span<const scene::Command> batch, const Editor& editor,
                                     NodeMakers& makers, const std::function<void(const scene::Command&)>& applied) {
  BatchRights rights(store, editor, makers);
  for (std::size_t i = 0; i < batch.size(); ++i)
    if (auto why = rights.refusal(batch[i])) return EditRefusal{i, std::move(*why)};
  const auto undo = scene::apply_whole(store, batch);
  if (!undo) return EditRefusal{undo.error().index, describe(undo.error().why)};
  for (const scene::Command& command : batch) {
    if (const auto* create = std::get_if<scene::NodeCreate>(&command)) makers[create->node] = editor.name;
    if (const auto* destroy = std::get_if<scene::NodeDestroy>(&command)) makers.erase(destroy->node);
    applied(command);
  }
  return std::nullopt;
}

}  // namespace septet::server
