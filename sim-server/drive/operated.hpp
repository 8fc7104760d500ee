#pragma once
/// What an operator does to a drive, from the page or by a line of an editor, and how the log tells of it.

#include <optional>
#include <string>
#include <string_view>

#include "engine/core/expected.hpp"
#include "engine/world/snapshot.hpp"
#include "sim-server/drive/session_log.hpp"
#include "sim-server/drive/world_gate.hpp"
#include "sim-server/host/editor.hpp"

namespace septet::server {

/// Who commands: a name (empty: they gave none), and the rights by which they change the scene, where they have them.
struct Author {
  std::string name;
  std::optional<Editor> editor;
};
/// The operator at the page, and the storyboard: they may change all that stands in the scene, and create nothing.
Editor the_page();
Editor the_storyboard();

/// Executes a command: one of engine/simulation/operator_command.hpp; `scene LINE`, a change of the scene
/// (engine/scene/command_text.hpp), shown from tick `from` on; or `undo`, of the author's newest change of it. Returns the
/// text by which note_operator tells of it; empty: the log has all of it already. Error: why it is refused.
Expected<std::string> do_command(std::string_view text, const Author& author, Tick from, WorldGate& gate);

/// Logs an operator's mark, word, rating or wish (`kind`: that of the log) with their name; empty: they gave none.
void note_operator(const std::string& name, const std::string& kind, std::string_view what, SessionLog& log);

}  // namespace septet::server
