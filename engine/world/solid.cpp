#include "engine/world/solid.hpp"

#include <charconv>
#include <cstddef>
#include <system_error>

#include "engine/core/printable.hpp"

namespace septet {
namespace {

constexpr std::string_view before_struck = " what=\"";

}  // namespace

NamedText split_name(std::string_view command) {
  constexpr std::string_view key = " name=\"";
  const std::size_t at = command.find(key), name = at + key.size();
  if (at == command.npos || command.size() < name + 2 || !command.ends_with('"')) return {command, {}};
  return {command.substr(0, at), command.substr(name, command.size() - 1 - name)};
}

bool is_name_of_thing(std::string_view name) {
  constexpr std::size_t most_bytes = 1024;
  return name.size() <= most_bytes && name.find('"') == name.npos && printable_characters(name);
}

std::optional<NamedSolid> named_solid(std::string_view command) {
  constexpr std::string_view begin = "stand solid=";
  const NamedText text = split_name(command);
  if (!text.before.starts_with(begin) || text.name.empty()) return std::nullopt;
  std::uint32_t solid = 0;
  const char* const last = text.before.data() + text.before.size();
  const auto [end, error] = std::from_chars(text.before.data() + begin.size(), last, solid);
  if (error != std::errc() || (end != last && *end != ' ') || solid >= most_solids) return std::nullopt;
  return NamedSolid{first_solid_participant + solid, text.name};
}

std::string name_of_struck(std::string_view name) { return std::string(before_struck) + std::string(name) + '"'; }

std::optional<std::string> struck_by_name(std::string_view detail) {
  const std::size_t at = detail.find(before_struck);
  if (at == detail.npos || !detail.ends_with('"')) return std::nullopt;
  detail.remove_prefix(at + before_struck.size());
  if (detail.size() < 2) return std::nullopt;
  return std::string(detail.substr(0, detail.size() - 1));
}

}  // namespace septet
