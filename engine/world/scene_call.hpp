#pragma once
/// The storyboard's change of the scene, as a call (call.hpp) that the drive's own gate listens to: of this name, by the
/// storyboard alone, with one parameter, a line of engine/scene/command_text.hpp.

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "engine/world/call.hpp"

namespace septet {

inline constexpr std::string_view scene_call = "scene", scene_call_command = "command";

inline Call scene_call_of(std::string line) {
  return {.name = std::string(scene_call),
          .node = {},
          .parameters = {{std::string(scene_call_command), std::move(line)}},
          .by = std::string(storyboard_calls)};
}

/// The line of an event with this kind and detail; empty: it is another event.
inline std::optional<std::string> scene_line_of(std::string_view kind, std::string_view detail) {
  if (kind != call_event) return std::nullopt;
  const auto call = read_call(detail);
  if (!call || call->by != storyboard_calls || call->name != scene_call || call->parameters.size() != 1)
    return std::nullopt;
  return call->parameters.front().second;
}

}  // namespace septet
