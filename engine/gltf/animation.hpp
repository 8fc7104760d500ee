#pragma once
/// Animations of nodes: place, turn, size and weights of morph targets by time (glTF 2.0, 3.11 and appendix C), as keys
/// of a part or as they are at one time.
///
/// All of a file's animations play together and repeat after the longest; of two that move one thing of a node the
/// first does.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/gltf/channel.hpp"
#include "engine/gltf/container.hpp"
#include "engine/gltf/nodes.hpp"
#include "engine/math/pose_keys.hpp"

namespace septet::gltf {

struct NodeChannels {
  std::optional<Channel> translation, rotation, scale;
  std::optional<Channel> weights;  ///< A row has one of each target.

  bool moves() const { return translation || rotation || scale; }
};

struct Animations {
  std::map<std::int64_t, NodeChannels> by_node;
  float period_s = 0.0f;

  /// True for a node that goes, turns or grows of itself.
  bool move(std::int64_t node) const {
    const auto found = by_node.find(node);
    return found != by_node.end() && found->second.moves();
  }
};

/// `left_out`: gets a sentence for each kind of what is not played. Error: a channel without its sampler, node or rows,
/// times that do not rise, more than 10,000 of them.
Expected<Animations> read_animations(const Container& container, std::vector<std::string>& left_out);

/// Poses of a node in the model; `chain`: the nodes from the root to it. Axes are glTF's. A chain that interpolates by
/// curves, or moves at several nodes, is taken 60 times a second, and less often beyond `max_pose_keys`.
std::vector<PoseKey> keys_of_chain(const Container& container, const Animations& animations,
                                   const std::vector<std::int64_t>& chain);

/// The nodes that `placed` has, where they are at a time.
PlacedNodes placed_at(const Container& container, const Animations& animations, const PlacedNodes& placed,
                      double time_s);

/// The weights of a node's morph targets at a time; empty where no animation has any.
std::vector<float> weights_at(const Animations& animations, std::int64_t node, double time_s);

}  // namespace septet::gltf
