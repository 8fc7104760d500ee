#include "sim-server/drive/operated.hpp"

#include <utility>
#include <variant>

#include <fmt/core.h>

#include "engine/scene/command_text.hpp"
#include "engine/simulation/operator_command.hpp"
#include "engine/world/scene_call.hpp"
#include "sim-server/drive/name_in_log.hpp"

namespace septet::server {

namespace {

constexpr std::string_view nameless = "operator", scene_word = "scene ", undo_word = "undo";

/// A call of this author, about a node that is there.
Expected<void> complete_call(Call& call, const std::string& by, const scene::Store& scene) {
  if (call.name == scene_call)
    return failure("calls of this name are the storyboard's", std::string(scene_call), "write scene COMMAND");
  constexpr std::size_t longest = longest_call_value - std::string_view("…").size();
  call.by = by.empty() ? nameless : in_quotes_in_log(by, longest);
  if (!call.node.empty() && !scene::node_of({scene}, {call.node}))
    return failure("the scene has no node of this name", call.node, "name another one, or leave node away");
  return {};
}

/// Of a prefix that all names begin with.
Editor of_all_nodes(std::string name) { return {std::move(name), {{""}, net::all_edit_kinds}, 0}; }

Expected<std::string> change_scene(std::string_view text, const Author& author, Tick from, WorldGate& gate) {
  if (!author.editor)
    return failure("this key may operate, not edit", std::string(text.substr(0, 80)),
                   fmt::format("allowed-clients needs `KEY {} edit operate`", author.name));
  if (text == undo_word) {
    if (const auto refused = gate.undo(*author.editor, from))
      return failure(refused->failures.front().why, std::string(undo_word), "change it back by another command");
  } else if (auto made = gate.make_line(*author.editor, text.substr(scene_word.size()), from); !made) {
    return tl::unexpected(made.error());
  }
  return std::string(text);
}

}  // namespace

// Names that no key has.
Editor the_page() { return of_all_nodes("the operator's page"); }
Editor the_storyboard() { return of_all_nodes("the storyboard"); }

Expected<std::string> do_command(std::string_view text, const Author& author, Tick from, WorldGate& gate) {
  if (text == undo_word || text.starts_with(scene_word)) return change_scene(text, author, from, gate);
  auto command = simulation::parse_operator_command(text);
  if (!command) return tl::unexpected(command.error());
  if (std::holds_alternative<simulation::StandSolid>(*command) ||
      std::holds_alternative<simulation::ClearSolid>(*command) ||
      std::holds_alternative<simulation::ShowStanding>(*command))
    return failure("what stands follows the scene: what is met is what is drawn", "operator's command",
                   "let an editor hide a thing, or set its tag body.solid (docs/editing.md)");
  auto* const call = std::get_if<Call>(&*command);
  if (auto completed = call ? complete_call(*call, author.name, gate.scene()) : Expected<void>(); !completed)
    return tl::unexpected(completed.error());
  if (auto done = gate.drive().command(*command); !done) return tl::unexpected(done.error());
  return call ? std::string() : simulation::text_of(*command);
}

void note_operator(const std::string& name, const std::string& kind, std::string_view what, SessionLog& log) {
  const char* const key = kind == "mark" ? "note" : kind == "word" ? "text" : "wish";
  log.record_message(kind, fmt::format("by={} {}={}", name.empty() ? nameless : name, key, what));
}

}  // namespace septet::server
