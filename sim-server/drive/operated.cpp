#include "sim-server/drive/operated.hpp"

#include <algorithm>
#include <variant>

#include <fmt/core.h>

#include "engine/core/printable.hpp"
#include "engine/scene/command_text.hpp"
#include "engine/simulation/operator_command.hpp"

namespace septet::server {

namespace {

constexpr std::string_view nameless = "operator";

/// A call of this author, about a node that is there.
Expected<void> complete(Call& call, const std::string& by, const scene::Store& scene) {
  constexpr std::size_t longest = longest_call_value - std::string_view("…").size();
  call.by = by.empty() ? nameless : printable(by, longest);
  std::ranges::replace(call.by, '"', '\'');
  if (!call.node.empty() && !scene::node_of({scene}, {call.node}))
    return failure("the scene has no node of this name", call.node, "name another one, or leave node away");
  return {};
}

}  // namespace

Expected<std::string> do_command(std::string_view text, const std::string& by, const scene::Store& scene,
                                 LiveDrive& drive) {
  auto command = simulation::parse_operator_command(text);
  if (!command) return tl::unexpected(command.error());
  if (std::holds_alternative<simulation::StandSolid>(*command) ||
      std::holds_alternative<simulation::ClearSolid>(*command) ||
      std::holds_alternative<simulation::ShowStanding>(*command))
    return failure("what stands follows the scene: what is met is what is drawn", "operator's command",
                   "let an editor hide a thing, or set its tag body.solid (docs/editing.md)");
  auto* const call = std::get_if<Call>(&*command);
  if (auto completed = call ? complete(*call, by, scene) : Expected<void>(); !completed)
    return tl::unexpected(completed.error());
  if (auto done = drive.command(*command); !done) return tl::unexpected(done.error());
  return call ? std::string() : simulation::text_of(*command);
}

void note_operator(const std::string& name, const std::string& kind, std::string_view what, SessionLog& log) {
  const char* const key = kind == "mark" ? "note" : kind == "word" ? "text" : "wish";
  log.record_message(kind, fmt::format("by={} {}={}", name.empty() ? nameless : name, key, what));
}

}  // namespace septet::server
