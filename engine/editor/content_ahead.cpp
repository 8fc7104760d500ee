#include "engine/editor/content_ahead.hpp"

#include <numeric>
#include <set>
#include <variant>

#include "engine/core/bytes.hpp"
#include "engine/replication/message.hpp"
#include "engine/scene/command_codec.hpp"

namespace septet::editor {
namespace {

std::size_t bytes_of(const scene::Command& command) {
  Bytes bytes;
  scene::encode(command, bytes);
  return bytes.size();
}

/// The node that a command is about.
scene::NodeId node_of(const scene::Command& command) {
  return std::visit(
      [](const auto& c) {
        if constexpr (requires { c.node; })
          return c.node;
        else
          return scene::no_node;
      },
      command);
}

}  // namespace

SplitBatch split_content(std::span<const scene::Command> batch) {
  SplitBatch split;
  std::vector<std::size_t> bytes;
  bytes.reserve(batch.size());
  for (const scene::Command& command : batch) bytes.push_back(bytes_of(command));
  const bool is_small = batch.size() <= replication::most_changes_of_batch &&
                        std::accumulate(bytes.begin(), bytes.end(), std::size_t{0}) <= replication::max_batch_bytes;
  std::set<scene::NodeId> content;
  std::size_t filled = 0;
  for (std::size_t i = 0; i < batch.size(); ++i) {
    const scene::Command& command = batch[i];
    const auto* create = std::get_if<scene::NodeCreate>(&command);
    if (create && !is_small && create->type != scene::NodeType::object) content.insert(create->node);
    if (!content.contains(node_of(command))) {
      split.rest.push_back(command);
      split.rest_from.push_back(i);
      continue;
    }
    const bool is_full = !split.ahead.empty() && (filled + bytes[i] > replication::max_batch_bytes ||
                                                  split.ahead.back().size() == replication::most_changes_of_batch);
    if (split.ahead.empty() || is_full) {
      split.ahead.emplace_back();
      filled = 0;
    }
    split.ahead.back().push_back(command);
    filled += bytes[i];
  }
  return split;
}

}  // namespace septet::editor
