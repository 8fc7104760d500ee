#include "engine/world/solid.hpp"

#include <charconv>
#include <system_error>

namespace septet {
namespace {

constexpr std::string_view before_struck = " what=\"";

}  // namespace

std::optional<NamedSolid> named_solid(std::string_view command) {
  constexpr std::string_view begin = "stand solid=", before_name = " name=\"";
  const std::size_t name = command.find(before_name);
  if (!command.starts_with(begin) || name == command.npos || !command.ends_with('"')) return std::nullopt;
  std::uint32_t solid = 0;
  const auto [end, error] = std::from_chars(command.data() + begin.size(), command.data() + command.size(), solid);
  if (error != std::errc() || *end != ' ' || solid >= most_solids) return std::nullopt;
  command.remove_prefix(name + before_name.size());
  if (command.size() < 2) return std::nullopt;
  return NamedSolid{first_solid_participant + solid, command.substr(0, command.size() - 1)};
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
