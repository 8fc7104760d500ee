#pragma once
/// Nodes of a file's default scene and their places (glTF 2.0, 3.5).

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/mat4x4.hpp>

#include "engine/core/expected.hpp"
#include "engine/gltf/container.hpp"

namespace septet::gltf {

/// What an animation puts in the place of a node's own; empty: the node's.
struct NodePose {
  std::optional<std::array<float, 3>> translation;
  std::optional<std::array<float, 4>> rotation;  ///< x, y, z, w.
  std::optional<std::array<float, 3>> scale;
};
glm::mat4 parent_from_node(const Json& node, const NodePose& instead = {});

/// Axes are glTF's.
struct PlacedNodes {
  std::vector<std::int64_t> roots;
  std::vector<std::optional<glm::mat4>> model_from_node;  ///< By node; empty for one outside of the scene.
};

/// Without scenes the roots are the nodes that are no node's child. Error: no such scene or child, a node below two
/// nodes or below itself, a chain of more than 256.
Expected<PlacedNodes> place_nodes(const Container& container);

/// The index that a list of nodes holds; −1 where the file has no such node.
std::int64_t node_index(const Json& file, const Json& number);

}  // namespace septet::gltf
