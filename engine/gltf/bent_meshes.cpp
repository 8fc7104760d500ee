#include "engine/gltf/bent_meshes.hpp"

#include <algorithm>
#include <cmath>

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include "engine/gltf/primitive.hpp"

namespace septet::gltf {
namespace {

constexpr double poses_a_second = 30.0;
constexpr std::size_t most_placed_nodes = 1'000'000;  ///< In all poses.

/// Adds a node and those below it that move: of themselves, or with one above.
void add_moving(const Container& container, const Animations& animations, std::int64_t index, bool moves,
                std::set<std::int64_t>& moving) {
  moves |= animations.move(index);
  if (moves) moving.insert(index);
  for (const Json& child : list_of(list_of(*container.json, "nodes")[static_cast<std::size_t>(index)], "children"))
    add_moving(container, animations, node_index(*container.json, child), moves, moving);
}

bool has_weights(const Animations& animations, std::int64_t node) {
  const auto found = animations.by_node.find(node);
  return found != animations.by_node.end() && found->second.weights;
}

bool has_moving_joint(const Container& container, const Json& node, const std::set<std::int64_t>& moving) {
  const Json& skins = list_of(*container.json, "skins");
  const std::int64_t skin = index_in(node, "skin");
  if (skin < 0 || static_cast<std::uint64_t>(skin) >= skins.size()) return false;
  return std::ranges::any_of(list_of(skins[static_cast<std::size_t>(skin)], "joints"),
                             [&](const Json& joint) { return moving.contains(node_index(*container.json, joint)); });
}

}  // namespace

BentMeshes find_bent_meshes(const Container& container, const Animations& animations, const PlacedNodes& placed) {
  BentMeshes bent;
  std::set<std::int64_t> moving;
  for (const std::int64_t root : placed.roots) add_moving(container, animations, root, false, moving);
  const Json& nodes = list_of(*container.json, "nodes");
  const Json& meshes = list_of(*container.json, "meshes");
  std::size_t size = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto index = static_cast<std::int64_t>(i);
    if (!placed.model_from_node[i] || !nodes[i].is_object()) continue;
    const std::int64_t mesh = index_in(nodes[i], "mesh");
    if (mesh < 0 || static_cast<std::uint64_t>(mesh) >= meshes.size()) continue;
    if (!has_weights(animations, index) && !has_moving_joint(container, nodes[i], moving)) continue;
    bent.nodes.insert(index);
    size = std::min(size + 1, most_bent_size + 1);  // An empty one takes time, too.
    for (const Json& primitive : list_of(meshes[static_cast<std::size_t>(mesh)], "primitives"))
      size = std::min(size + std::min(size_of(container, primitive), most_bent_size + 1), most_bent_size + 1);
  }
  if (bent.nodes.empty() || !(animations.period_s > 0.0f)) return bent;
  const double wanted = std::ceil(double{animations.period_s} * poses_a_second);
  const auto by_time = static_cast<std::size_t>(std::clamp(wanted, 2.0, static_cast<double>(most_bent_poses)));
  bent.poses = std::min({by_time, most_bent_size / size, most_placed_nodes / nodes.size()});
  return bent;
}

double bent_pose_time_s(std::size_t pose, std::size_t poses, double period_s) {
  return period_s * (static_cast<double>(pose) + 0.5) / static_cast<double>(poses);
}

std::vector<PoseKey> keys_of_bent_pose(std::size_t pose, std::size_t poses, double period_s) {
  const auto at_s = [&](std::size_t share) {
    return static_cast<float>(period_s * static_cast<double>(share) / static_cast<double>(poses));
  };
  PoseKey gone, there;
  gone.scale = glm::vec3(0.0f);
  std::vector<PoseKey> keys;
  const auto add = [&](PoseKey key, float time_s) {
    key.at_s = time_s;
    keys.push_back(key);
  };
  if (pose > 0) {
    add(gone, 0.0f);
    add(gone, at_s(pose));
  }
  add(there, at_s(pose));
  add(there, at_s(pose + 1));
  if (pose + 1 < poses) {
    add(gone, at_s(pose + 1));
    add(gone, at_s(poses));
  }
  return keys;
}

}  // namespace septet::gltf
