#pragma once
/// Looks that an editor's lines have given to things (`board`, `text`, `picture`, `color`): a new look takes the place of
/// the old one, whose nodes go with the same batch where nobody wears them any more. So a sign whose text changes each
/// second is as large after an hour as after a second. Undoing the batch brings them back.

#include <map>
#include <span>
#include <utility>
#include <vector>

#include "engine/scene/command.hpp"
#include "engine/scene/store.hpp"

namespace septet::editor {

struct Paints {
  /// Materials that lines have made, each with its picture; no_node: it has none. Those that are gone stay a while, as undo
  /// may bring them back.
  std::map<scene::NodeId, scene::NodeId> pictures{};
  /// Materials by the objects' links that lines have set since the scene was last known whole.
  std::map<std::pair<scene::NodeId, scene::PartId>, scene::NodeId> worn{};
};

/// Materials that the commands make are paints.
void learn_paints(Paints& paints, std::span<const scene::Command> commands);
/// The links by which objects wear materials, and those that the command takes or sets.
void learn_worn(Paints& paints, const scene::Command& command);

/// `line` gives things another look, and is learnt here. Returns the commands that destroy what then nobody wears: of all
/// paints those that the scene has, and those that the line takes the place of, which may still be to come.
std::vector<scene::Command> take_place(Paints& paints, const scene::Store& store, std::span<const scene::Command> line);

}  // namespace septet::editor
