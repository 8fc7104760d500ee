#pragma once
/// The node store: the world's content, as the server owns it and as a screen mirrors it.
///
/// Every change goes through `apply`. A command may come from the network: with any content, it is either applied whole
/// or refused with a reason, and a refused one changes nothing. Memory is bounded by StoreLimits. Iteration is in order
/// of id, so that equal stores give equal command streams. Not safe to share between threads while it is changed.

#include <cstdint>
#include <functional>
#include <map>

#include "engine/core/expected.hpp"
#include "engine/scene/change_list.hpp"
#include "engine/scene/command.hpp"

namespace septet::scene {

struct StoreLimits {
  std::size_t nodes = 1u << 18;
  std::uint32_t vertices = 1u << 22;  ///< Limit of one geometry.
  std::uint32_t polygons = 1u << 22;
  std::uint32_t bitmap_side = 8192;
  std::uint64_t bytes = std::uint64_t{1} << 30;  ///< Limit of all content together.
};

/// A node that changed or was destroyed; where tiles alone changed, which.
struct NodeChange {
  NodeId node = no_node;
  PartId layer = 0;
  std::uint32_t first_tile = 0, tiles = 0;  ///< No tiles: anything of the node.
  bool operator==(const NodeChange&) const = default;
};

class Store {
 public:
  explicit Store(const StoreLimits& limits = {}) : limits_(limits) {}

  /// Applies one command. Subscriptions do not belong to the store and are refused.
  Expected<void> apply(const Command& command);

  /// The next id, never one that was in use before. For the owner of the store: a server.
  NodeId assign_id();

  const std::map<NodeId, Node>& nodes() const { return nodes_; }
  const Node* find(NodeId id) const;
  /// The lowest node of that name and type, or null.
  const Node* find(NodeType type, std::string_view name) const;

  /// Counts the applied commands, without those that destroyed an absent object.
  std::uint64_t revision() const { return revision_; }
  /// The revision at which a node was last created or destroyed.
  std::uint64_t index_revision() const { return index_revision_; }
  std::uint64_t content_bytes() const { return content_bytes_; }
  /// The nodes by the revisions that changed them.
  const ChangeList<NodeChange>& changes() const { return changes_; }

 private:
  struct Application;  // Application of one command: store_apply.cpp.

  StoreLimits limits_;
  std::map<NodeId, Node> nodes_;
  NodeId next_id_ = 1;
  std::uint64_t revision_ = 0;
  std::uint64_t index_revision_ = 0;
  std::uint64_t content_bytes_ = 0;
  ChangeList<NodeChange> changes_;
};

/// The commands that build this node, or the whole store, in an empty store, in runs of at most `run_values` numbers.
void describe_node(const Node& node, const std::function<void(Command)>& emit, std::size_t run_values = 65536);
void describe_store(const Store& store, const std::function<void(Command)>& emit, std::size_t run_values = 65536);

/// True where both hold the same content; revisions do not count.
bool same_content(const Node& a, const Node& b);
bool same_content(const Store& a, const Store& b);

}  // namespace septet::scene
