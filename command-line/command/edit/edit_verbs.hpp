#pragma once
/// The verbs of `septet edit` beside the bare node commands, each a few commands (docs/editing.md).

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/scene/command.hpp"
#include "engine/scene/command_text.hpp"
#include "engine/scene/store.hpp"

namespace septet::server {

/// What an editor's lines have made so far. The mirror may lag behind.
struct EditNames {
  scene::NodeId own_ids = 0;
  scene::NodeId next = 0;                                     ///< First of the own ids that is free.
  std::map<std::string, scene::NodeId, std::less<>> fresh{};  ///< Objects by the names given to them.
  std::set<scene::NodeId> objects{};                          ///< Created.
};

struct EditedLine {
  std::vector<scene::Command> commands;
  std::vector<std::string> messages{};
};

/// The commands of one line. Error: which word is wrong, what a file lacks, or that the own ids are used up.
Expected<EditedLine> edit_of(const std::vector<scene::TextWord>& words, const scene::Store& store, EditNames& names);

/// A place: nothing, X Y Z, or X Y Z HEADING_DEG. Empty: other words.
std::optional<scene::Transform> transform_of(std::span<const scene::TextWord> words);

/// The nodes that `find` means: a pattern of names (* and ?), then `type TYPE`, `tag GROUP.TAG`, `near X Y METRES`. At most
/// a thousand.
Expected<std::vector<scene::NodeId>> found_nodes(const std::vector<scene::TextWord>& words, const scene::Store& store);

}  // namespace septet::server
