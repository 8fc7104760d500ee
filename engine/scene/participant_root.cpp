#include "engine/scene/participant_root.hpp"

#include <charconv>
#include <system_error>
#include <variant>

#include <fmt/core.h>

namespace septet::scene {
namespace {

constexpr std::string_view prefix = "participant/";

}  // namespace

std::string participant_prototype(std::uint32_t number) { return fmt::format("{}{}", prefix, number); }

std::optional<std::uint32_t> number_of_participant(std::string_view prototype) {
  if (!prototype.starts_with(prefix)) return std::nullopt;
  prototype.remove_prefix(prefix.size());
  std::uint32_t number = 0;
  const char* const end = prototype.data() + prototype.size();
  const auto [stop, error] = std::from_chars(prototype.data(), end, number);
  return error == std::errc() && stop == end ? std::optional(number) : std::nullopt;
}

std::vector<std::pair<std::string, std::uint32_t>> participant_names(const Store& store) {
  std::vector<std::pair<std::string, std::uint32_t>> names;
  for (const auto& [id, node] : store.nodes()) {
    if (!node.name.starts_with(prototype_prefix)) continue;
    const auto number = number_of_participant(std::string_view(node.name).substr(prototype_prefix.size()));
    const TagValue* tag = number ? find_tag(node, participant_tag_group, participant_name_tag) : nullptr;
    if (const auto* name = tag ? std::get_if<std::string>(tag) : nullptr) names.emplace_back(*name, *number);
  }
  return names;
}

}  // namespace septet::scene
