#include "engine/editor/content_ahead.hpp"

#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <variant>

#include "engine/core/bytes.hpp"
#include "engine/replication/message.hpp"
#include "engine/scene/command_codec.hpp"
#include "engine/scene/growth.hpp"
#include "engine/scene/store.hpp"

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

struct Step {
  scene::Command command;
  std::uint64_t grown_bytes = 0;
};

/// The first size of each geometry that a batch makes, as sizes that rise to it, each within a batch's growth; its layers come
/// before them, and grow with it.
class StepsOfSize {
 public:
  explicit StepsOfSize(std::span<const scene::Command> batch) {
    for (const scene::Command& command : batch)
      if (const auto* layer = std::get_if<scene::GeometryLayerSet>(&command))
        layers_[layer->node].push_back(*layer);
      else if (const auto* size = std::get_if<scene::GeometrySizeSet>(&command))
        sized_.insert(size->node);
  }
  std::vector<Step> of(const scene::Command& command) {
    if (const auto* layer = std::get_if<scene::GeometryLayerSet>(&command); layer && sized_.contains(layer->node))
      return {};
    const auto* size = std::get_if<scene::GeometrySizeSet>(&command);
    if (!size || !begun_.insert(size->node).second) return {{command}};
    std::vector<scene::Command> whole = layers_[size->node];
    std::vector<Step> steps;
    steps.reserve(whole.size());
    for (const scene::Command& layer : whole) steps.push_back({layer});
    whole.emplace_back(*size);
    const std::uint64_t grown = scene::grown_bytes(scene::Store(), whole);
    const std::uint64_t count = grown / (replication::most_grown_bytes_of_batch / 2) + 1;  // Rounded up, each is less.
    const auto part = [&](std::uint64_t elements, std::uint64_t step) {
      return static_cast<std::uint32_t>(elements * step / count);
    };
    for (std::uint64_t step = 1; step <= count; ++step)
      steps.push_back({scene::GeometrySizeSet{size->node, part(size->vertices, step), part(size->polygons, step)},
                       grown / count + 1024});
    return steps;
  }

 private:
  std::map<scene::NodeId, std::vector<scene::Command>> layers_;
  std::set<scene::NodeId> sized_, begun_;
};

/// Batches that are sent before the one that shows what they make.
class AheadBatches {
 public:
  void add(Step step) {
    const std::size_t bytes = bytes_of(step.command);
    const bool is_full = !batches_.empty() && (filled_ + bytes > replication::max_batch_bytes ||
                                               grown_ + step.grown_bytes > replication::most_grown_bytes_of_batch ||
                                               batches_.back().size() == replication::most_changes_of_batch);
    if (batches_.empty() || is_full) {
      batches_.emplace_back();
      filled_ = grown_ = 0;
    }
    filled_ += bytes;
    grown_ += step.grown_bytes;
    batches_.back().push_back(std::move(step.command));
  }
  std::vector<std::vector<scene::Command>> take() { return std::move(batches_); }

 private:
  std::vector<std::vector<scene::Command>> batches_;
  std::size_t filled_ = 0;
  std::uint64_t grown_ = 0;
};

}  // namespace

SplitBatch split_content(std::span<const scene::Command> batch) {
  SplitBatch split;
  std::size_t bytes = 0;
  for (const scene::Command& command : batch) bytes += bytes_of(command);
  const bool is_small = batch.size() <= replication::most_changes_of_batch && bytes <= replication::max_batch_bytes &&
                        scene::grown_bytes(scene::Store(), batch) <= replication::most_grown_bytes_of_batch;
  StepsOfSize steps(batch);
  AheadBatches ahead;
  std::set<scene::NodeId> content;
  for (std::size_t i = 0; i < batch.size(); ++i) {
    const scene::Command& command = batch[i];
    const auto* create = std::get_if<scene::NodeCreate>(&command);
    if (create && !is_small && create->type != scene::NodeType::object) content.insert(create->node);
    if (!content.contains(node_of(command))) {
      split.rest.push_back(command);
      split.rest_from.push_back(i);
      continue;
    }
    for (Step& step : steps.of(command)) ahead.add(std::move(step));
  }
  split.ahead = ahead.take();
  return split;
}

}  // namespace septet::editor
