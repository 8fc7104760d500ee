#include "engine/gltf/morph.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/gltf/gltf.hpp"

namespace septet::gltf {
namespace {

constexpr std::size_t most_targets = 256;

Expected<void> add_rows(const Container& container, const Json& target, const char* name, float weight, Rows& rows,
                        const std::string& where) {
  if (rows.count == 0 || !target.is_object() || !target.contains(name)) return {};
  const auto moved = read_rows(container, index_in(target, name), 3, 3, most_vertices);
  if (!moved) return tl::unexpected(moved.error());
  if (moved->count != rows.count)
    return failure(fmt::format("{} of a morph target has {} rows, not {}", name, moved->count, rows.count), where,
                   export_anew);
  for (std::size_t i = 0; i < rows.numbers.size(); ++i) rows.numbers[i] += weight * moved->numbers[i];
  return {};
}

}  // namespace

std::vector<float> weights_of(const Json& node, const Json& mesh) {
  const Json& own = list_of(node, "weights");
  const Json& list = own.empty() ? list_of(mesh, "weights") : own;
  std::vector<float> weights;
  for (std::size_t i = 0; i < std::min(list.size(), most_targets); ++i)
    weights.push_back(list[i].is_number() ? static_cast<float>(std::clamp(list[i].get<double>(), -100.0, 100.0))
                                          : 0.0f);
  return weights;
}

Expected<void> add_targets(const Container& container, const Json& primitive, const std::vector<float>& weights,
                           Rows& positions, Rows& normals, const std::string& where) {
  const Json& targets = list_of(primitive, "targets");
  for (std::size_t i = 0; i < std::min(weights.size(), targets.size()); ++i) {
    if (weights[i] == 0.0f) continue;
    for (auto& [name, rows] : {std::pair<const char*, Rows*>{"POSITION", &positions}, {"NORMAL", &normals}})
      if (auto added = add_rows(container, targets[i], name, weights[i], *rows, where); !added) return added;
  }
  return {};
}

}  // namespace septet::gltf
