#include "sim-server/drive/world_gate.hpp"

#include <algorithm>
#include <charconv>
#include <numeric>
#include <set>
#include <system_error>
#include <variant>

#include <fmt/core.h>

#include "engine/core/bytes.hpp"
#include "engine/core/printable.hpp"
#include "engine/scene/command_codec.hpp"
#include "engine/scene/command_text.hpp"
#include "engine/scene/command_validation.hpp"
#include "engine/scene/growth.hpp"
#include "engine/simulation/model.hpp"
#include "sim-server/drive/batch_failures.hpp"
#include "sim-server/drive/motion_times.hpp"

namespace septet::server {
namespace {

/// Why the shapes that a batch sizes would hold up the drive, or nothing.
std::optional<std::string> too_large(const scene::Store& store, std::span<const scene::Command> batch) {
  for (const scene::Command& command : batch)
    if (const auto* size = std::get_if<scene::GeometrySizeSet>(&command);
        size && std::max(size->vertices, size->polygons) > most_elements_of_shape)
      return fmt::format(
          "a shape of {} vertices and {} polygons, of each {} are the most: divide it among several nodes",
          size->vertices, size->polygons, most_elements_of_shape);
  constexpr std::uint64_t most = replication::most_grown_bytes_of_batch;
  const std::uint64_t grown = scene::grown_bytes(store, batch);
  if (grown <= most) return std::nullopt;
  return fmt::format(
      "its sizes let shapes grow by {} bytes, of which one batch, done whole between two ticks, has {} at most: set "
      "them in several batches",
      grown, most);
}

replication::Refusal refusal_of(std::string node, std::string why) {
  return {{{0, std::move(node), std::move(why)}}, 0};
}

/// Names kept of nodes that are gone.
constexpr std::size_t most_gone_named = 4096;

std::size_t encoded_bytes(std::span<const scene::Command> commands) {
  Bytes bytes;
  for (const scene::Command& command : commands) scene::encode(command, bytes);
  return bytes.size();
}

}  // namespace

/// A node that is gone has a number alone: its name says more.
replication::Refusal WorldGate::with_names(replication::Refusal refusal, std::span<const scene::Command> batch) const {
  for (replication::Failure& failed : refusal.failures) {
    if (failed.index >= batch.size() || std::holds_alternative<scene::NodeCreate>(batch[failed.index])) continue;
    scene::NodeId id = scene::no_node;
    const char* const end = failed.node.data() + failed.node.size();
    const auto [stop, error] = std::from_chars(failed.node.data(), end, id);
    const auto name = error == std::errc() && stop == end ? gone_.find(id) : gone_.end();
    if (name == gone_.end() || drive_.store.find(id)) continue;
    failed.node = name->second.substr(0, replication::max_failed_name_bytes);
    failed.why = fmt::format("{} is gone: it was removed or replaced", failed.node);
  }
  return refusal;
}

/// Before the batch is done.
void WorldGate::note_gone(std::span<const scene::Command> batch) {
  for (const scene::Command& command : batch) {
    const auto* destroy = std::get_if<scene::NodeDestroy>(&command);
    const scene::Node* node = destroy ? drive_.store.find(destroy->node) : nullptr;
    if (!node || node->name.empty()) continue;
    if (gone_.size() >= most_gone_named) gone_.erase(gone_.begin());
    gone_[destroy->node] = node->name;
  }
}

/// What the scene makes of the simulation: commands that were found possible, so none is refused.
void WorldGate::execute(const std::vector<simulation::OperatorCommand>& commands) {
  for (const simulation::OperatorCommand& command : commands)
    if (const auto done = drive_.live->command(command); !done) messages_.push_back(describe(done.error()));
}

/// Belongs to no author, and nobody undoes it.
void WorldGate::tag_pushable(Tick from) {
  const std::vector<scene::Command> tags = solids_.missing_tags(drive_.store);
  for (const scene::Command& tag : tags) {
    if (const auto done = drive_.store.apply(tag); !done) messages_.push_back(describe(done.error()));
    done_(tag, from);
  }
  if (log_ && !tags.empty()) log_->record_edits(from, tags);
}

void WorldGate::begin() {
  SolidChange solids = solids_.begin(drive_.store, *drive_.loaded.model, drive_.live->state(), messages_);
  execute(solids.commands);
  solids_.take_over(std::move(solids));
  execute(drive_.standing.begin(drive_.store, *drive_.loaded.model, drive_.live->state(), messages_));
  tag_pushable(drive_.live->state().tick);
}

std::optional<replication::Refusal> WorldGate::pass(const Editor& editor, std::span<const scene::Command> batch,
                                                    Tick from, const Batch* undone, Batch* done) {
  // What an undo brings back was there.
  if (auto why = undone ? std::nullopt : too_large(drive_.store, batch)) return refusal_of({}, std::move(*why));
  note_gone(batch);
  NodeMakers destroyed;
  for (const scene::Command& command : batch)
    if (const auto* destroy = std::get_if<scene::NodeDestroy>(&command)) {
      const auto maker = makers_.find(destroy->node);
      destroyed.emplace(destroy->node, maker == makers_.end() ? std::string() : maker->second);
    }
  SolidChange solids;
  std::vector<simulation::OperatorCommand> standing;
  const auto accept = [&]() -> std::optional<replication::Failure> {
    auto change = solids_.change(drive_.store, batch, editor, *drive_.loaded.model, drive_.live->state());
    if (!change) return change.error();
    auto shown = drive_.standing.change(drive_.store, batch, *drive_.loaded.model, drive_.live->state());
    if (!shown) return shown.error();
    solids = std::move(*change);
    standing = std::move(*shown);
    return std::nullopt;
  };
  std::vector<scene::Command> inverse;
  auto refused = pass_gate(
      drive_.store, batch, editor, makers_, [&](const scene::Command& command) { done_(command, from); }, accept,
      undone ? &undone->makers : nullptr, &inverse);
  if (refused) return with_names(std::move(*refused), batch);
  for (const scene::Command& command : batch) {
    const scene::NodeId node = scene::node_of(command);
    if (std::holds_alternative<scene::NodeDestroy>(command))
      changers_.erase(node);
    else if (node != scene::no_node)
      changers_[node] = editor.name;
  }
  execute(solids.commands);
  solids_.take_over(std::move(solids));
  execute(standing);
  for (const std::string& constant :
       constants_.news_of(batch, [&](scene::NodeId id) { return told_name(drive_.store, id); }))
    messages_.push_back(fmt::format("{} has set {}", editor.name, printable(constant, 400)));
  if (log_) log_->record_edits(from, batch);
  tag_pushable(from);
  if (done) *done = {std::move(inverse), std::move(destroyed)};
  return std::nullopt;
}

void WorldGate::remember(const Editor& editor, Batch batch) {
  batch.bytes = encoded_bytes(batch.inverse);
  auto& batches = undo_[editor.name];
  batches.push_back(std::move(batch));
  std::size_t bytes = 0;
  for (const Batch& one : batches) bytes += one.bytes;
  while (!batches.empty() && (batches.size() > most_undone_batches || bytes > most_undone_bytes)) {
    bytes -= batches.front().bytes;
    batches.pop_front();
  }
}

std::optional<replication::Refusal> WorldGate::make(const Editor& editor, std::vector<scene::Command> batch, Tick from,
                                                    bool may_be_undone) {
  put_true_times(drive_.store, batch, static_cast<double>(from) / simulation::tick_rate_hz,
                 [&](scene::NodeId id) { return solids_.pushed_pose(drive_.store, id, drive_.live->state()); });
  const auto left = without_gone(drive_.store, batch, editor.own_ids);
  Batch done;
  auto refused = pass(editor, left ? left->commands : batch, from, nullptr, may_be_undone ? &done : nullptr);
  if (refused && left)
    for (replication::Failure& failed : refused->failures) failed.index = left->places[failed.index];
  if (!refused && may_be_undone && !done.inverse.empty()) remember(editor, std::move(done));
  return refused;
}

Expected<void> WorldGate::make_line(const Editor& editor, std::string_view line, Tick from) {
  const auto words = scene::words_of(line);
  if (!words) return tl::unexpected(words.error());
  const auto command = words->empty()
                           ? failure("there is no command", "scene", "write one: engine/scene/command_text.hpp")
                           : scene::command_from_words(*words, {drive_.store, editor.own_ids});
  if (!command) return tl::unexpected(command.error());
  const auto refused = make(editor, {*command}, from);
  if (!refused) return {};
  const replication::Failure& failed = refused->failures.front();
  return failure(failed.why, failed.node.empty() ? std::string(line.substr(0, 200)) : failed.node,
                 "change another node, or otherwise");
}

std::optional<replication::Refusal> WorldGate::undo(const Editor& editor, Tick from) {
  auto& batches = undo_[editor.name];
  if (batches.empty()) return refusal_of({}, fmt::format("there is nothing of {}'s to be undone", editor.name));
  const Batch batch = std::move(batches.back());
  batches.pop_back();
  for (const scene::Command& command : batch.inverse) {
    const scene::NodeId node = scene::node_of(command);
    const auto changer = changers_.find(node);
    if (changer != changers_.end() && changer->second != editor.name)
      return refusal_of(told_name(drive_.store, node),
                        fmt::format("{} has changed {} since", changer->second, told_name(drive_.store, node)));
  }
  return pass(editor, batch.inverse, from, &batch, nullptr);
}

}  // namespace septet::server
