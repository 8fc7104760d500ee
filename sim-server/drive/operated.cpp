#include "sim-server/drive/operated.hpp"

#include <variant>

#include <fmt/core.h>

#include "engine/simulation/operator_command.hpp"

namespace septet::server {

Expected<std::string> do_command(std::string_view text, LiveDrive& drive) {
  const auto command = simulation::parse_operator_command(text);
  if (!command) return tl::unexpected(command.error());
  if (std::holds_alternative<simulation::StandSolid>(*command) ||
      std::holds_alternative<simulation::ClearSolid>(*command) ||
      std::holds_alternative<simulation::ShowStanding>(*command))
    return failure("what stands follows the scene: what is met is what is drawn", "operator's command",
                   "let an editor hide a thing, or set its tag body.solid (docs/editing.md)");
  if (auto done = drive.command(*command); !done) return tl::unexpected(done.error());
  return simulation::text_of(*command);
}

void note_operator(const std::string& name, const std::string& kind, std::string_view what, SessionLog& log) {
  const char* const key = kind == "mark" ? "note" : kind == "word" ? "text" : "wish";
  log.record_message(kind, fmt::format("by={} {}={}", name.empty() ? "operator" : name, key, what));
}

}  // namespace septet::server
