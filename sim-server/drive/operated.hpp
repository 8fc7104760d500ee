#pragma once
/// What an operator does to a drive, from the page or by a line of an editor, and how the log tells of it.

#include <string>
#include <string_view>

#include "engine/core/expected.hpp"
#include "engine/scene/store.hpp"
#include "sim-server/drive/live_drive.hpp"
#include "sim-server/drive/session_log.hpp"

namespace septet::server {

/// Executes a command (engine/simulation/operator_command.hpp) of somebody whose name is `by`; empty: they gave none. `scene`
/// has the nodes that a call may be about. Returns the text by which note_operator tells of it; empty: the log has all of it
/// already. Error: why it is refused.
Expected<std::string> do_command(std::string_view text, const std::string& by, const scene::Store& scene,
                                 LiveDrive& drive);

/// Logs an operator's mark, word, rating or wish (`kind`: that of the log) with their name; empty: they gave none.
void note_operator(const std::string& name, const std::string& kind, std::string_view what, SessionLog& log);

}  // namespace septet::server
