#include "engine/gltf/nodes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>

namespace septet::gltf {
namespace {

constexpr std::size_t deepest_node = 256;

/// Root nodes of the default scene; without scenes the nodes that are no node's child.
Expected<std::vector<std::int64_t>> root_nodes(const Container& container) {
  const Json& json = *container.json;
  const Json& nodes = list_of(json, "nodes");
  std::vector<std::int64_t> roots;
  const Json& scenes = list_of(json, "scenes");
  if (!scenes.empty()) {
    const std::int64_t scene = index_in(json, "scene", 0);
    if (scene < 0 || static_cast<std::uint64_t>(scene) >= scenes.size())
      return failure(fmt::format("its scene is none of its {}", scenes.size()), container.where, export_anew);
    for (const Json& node : list_of(scenes[static_cast<std::size_t>(scene)], "nodes"))
      roots.push_back(node_index(json, node));
    return roots;
  }
  std::vector<bool> is_child(nodes.size(), false);
  for (const Json& node : nodes)
    for (const Json& child : list_of(node, "children"))
      if (const std::int64_t index = node_index(json, child); index >= 0)
        is_child[static_cast<std::size_t>(index)] = true;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (!is_child[i]) roots.push_back(static_cast<std::int64_t>(i));
  return roots;
}

/// Empty where there are no such `numbers` of them.
template <std::size_t count>
std::optional<std::array<float, count>> numbers_of(const Json& object, const char* name) {
  const Json& list = list_of(object, name);
  if (list.size() != count) return std::nullopt;
  std::array<float, count> numbers{};
  for (std::size_t i = 0; i < count; ++i) {
    if (!list[i].is_number()) return std::nullopt;
    numbers[i] = static_cast<float>(std::clamp(list[i].get<double>(), -1e9, 1e9));
  }
  return numbers;
}

Expected<void> place(const Container& container, std::int64_t index, const glm::mat4& parent, std::size_t depth,
                     PlacedNodes& placed) {
  const Json& nodes = list_of(*container.json, "nodes");
  if (index < 0 || static_cast<std::uint64_t>(index) >= nodes.size())
    return failure(fmt::format("a node that is named is none of its {}", nodes.size()), container.where, export_anew);
  const std::string where = fmt::format("{}, node {}", container.where, index);
  auto& model_from_node = placed.model_from_node[static_cast<std::size_t>(index)];
  if (model_from_node) return failure("it hangs below two nodes, or below itself", where, export_anew);
  if (depth > deepest_node)
    return failure(fmt::format("it hangs more than {} nodes deep", deepest_node), where, export_anew);
  const Json& node = nodes[static_cast<std::size_t>(index)];
  model_from_node = parent * parent_from_node(node);
  for (const Json& child : list_of(node, "children"))
    if (auto below = place(container, node_index(*container.json, child), *model_from_node, depth + 1, placed); !below)
      return below;
  return {};
}

}  // namespace

glm::mat4 parent_from_node(const Json& node, const NodePose& instead) {
  glm::mat4 transform(1.0f);
  if (const auto matrix = numbers_of<16>(node, "matrix")) {
    for (int i = 0; i < 16; ++i) transform[i / 4][i % 4] = (*matrix)[static_cast<std::size_t>(i)];
    return transform;
  }
  const auto turn = instead.rotation ? instead.rotation : numbers_of<4>(node, "rotation");
  glm::quat rotation(1.0f, 0.0f, 0.0f, 0.0f);
  if (turn) rotation = glm::quat((*turn)[3], (*turn)[0], (*turn)[1], (*turn)[2]);
  const float length = glm::length(rotation);
  transform = glm::mat4(length > 1e-6f ? glm::mat3_cast(rotation / length) : glm::mat3(1.0f));
  if (const auto scale = instead.scale ? instead.scale : numbers_of<3>(node, "scale"))
    for (int i = 0; i < 3; ++i) transform[i] *= (*scale)[static_cast<std::size_t>(i)];
  if (const auto shift = instead.translation ? instead.translation : numbers_of<3>(node, "translation"))
    transform[3] = glm::vec4((*shift)[0], (*shift)[1], (*shift)[2], 1.0f);
  return transform;
}

std::int64_t node_index(const Json& file, const Json& number) {
  if (!number.is_number_unsigned() || number.get<std::uint64_t>() >= list_of(file, "nodes").size()) return -1;
  return number.get<std::int64_t>();
}

Expected<PlacedNodes> place_nodes(const Container& container) {
  auto roots = root_nodes(container);
  if (!roots) return tl::unexpected(roots.error());
  PlacedNodes placed{std::move(*roots), {}};
  placed.model_from_node.resize(list_of(*container.json, "nodes").size());
  for (const std::int64_t root : placed.roots)
    if (auto below = place(container, root, glm::mat4(1.0f), 0, placed); !below) return tl::unexpected(below.error());
  return placed;
}

}  // namespace septet::gltf
