#include "engine/scene/constants_told.hpp"

#include <variant>

#include <fmt/core.h>

#include "engine/scene/material_constants.hpp"

namespace septet::scene {

std::vector<std::string> ConstantsTold::news_of(std::span<const Command> batch,
                                                const std::function<std::string(NodeId)>& name_of) {
  std::vector<std::string> news;
  for (const Command& command : batch) {
    const auto* set = std::get_if<FragmentSet>(&command);
    if (!set) continue;
    std::string constant(constant_of(set->value));
    if (constant.empty() || told_.size() >= most_constants_told) continue;
    if (const auto [told, added] = told_.emplace(set->node, std::move(constant)); added)
      news.push_back(fmt::format("material {}, fragment {}, {}", name_of(set->node), set->fragment, told->second));
  }
  return news;
}

}  // namespace septet::scene
