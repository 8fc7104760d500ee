#pragma once
/// The verbs of an editor's lines beside the bare node commands, each a few commands (docs/editing.md).

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/editor/paints.hpp"
#include "engine/scene/command.hpp"
#include "engine/scene/command_text.hpp"
#include "engine/scene/store.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::editor {

/// What an editor's lines have made so far. The mirror may lag behind.
struct EditNames {
  scene::NodeId own_ids = 0;
  scene::NodeId next = 0;                                     ///< First of the own ids that is free.
  std::map<std::string, scene::NodeId, std::less<>> fresh{};  ///< Objects by the names given to them.
  std::set<scene::NodeId> objects{};                          ///< Created.
  std::set<scene::NodeId> going{};                            ///< Set in motion, and not halted by a place since.
  Paints paints{};
  scene::NodeId kept_to = 0;  ///< Own ids below it are spoken for, used or not.
};

struct EditedLine {
  std::vector<scene::Command> commands;
  std::vector<std::string> messages{};
};

/// A thing of this editor's own that is to be gone.
struct Lifetime {
  std::string thing;  ///< As it was named.
  scene::NodeId node = 0;
  double seconds = 0.0;  ///< Of drive time, after the tick that shows its batch first.
};

/// The commands of one line. Error: which word is wrong, what a file lacks, or that the own ids are used up.
Expected<EditedLine> edit_of(const std::vector<scene::TextWord>& words, const scene::Store& store, EditNames& names);

/// Of `lifetime NODE SECONDS`. Error: which word is wrong.
Expected<Lifetime> lifetime_of(const std::vector<scene::TextWord>& words, const scene::Store& store,
                               const EditNames& names);
/// Commands that destroy a thing and all that it links to of these own ids, by the scene and by a batch after it.
std::vector<scene::Command> removal_of(scene::NodeId thing, const scene::Store& store, scene::NodeId own_ids,
                                       std::span<const scene::Command> batch);
/// Names of things that are destroyed mean nothing.
void forget_destroyed(EditNames& names, std::span<const scene::Command> batch);

/// A place: nothing, X Y Z, or X Y Z HEADING_DEG. Empty: other words.
std::optional<scene::Transform> transform_of(std::span<const scene::TextWord> words);

/// The nodes that `find` means: a pattern of names (* and ?), then `type TYPE`, `tag GROUP.TAG`, `near X Y METRES`, which
/// counts from where things are at `now`. One more than `most_nodes_found`: there are more.
inline constexpr std::size_t most_nodes_found = 1000;
Expected<std::vector<scene::NodeId>> found_nodes(const std::vector<scene::TextWord>& words, const scene::Store& store,
                                                 const Snapshot& now);

}  // namespace septet::editor
