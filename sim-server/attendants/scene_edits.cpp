#include "sim-server/attendants/scene_edits.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include <fmt/core.h>

#include "engine/document/text_file.hpp"
#include "engine/scene/edit_file.hpp"
#include "engine/simulation/model.hpp"
#include "program/console.hpp"
#include "sim-server/drive/motion_times.hpp"

namespace septet::server {
namespace {

/// Of all batches that wait for a tick.
constexpr std::size_t most_bytes_ahead = 64u << 20;

std::size_t bytes_of(const SceneRequest& request) {
  return request.batch.bytes + request.batch.changes.size() * sizeof(scene::Command);
}

}  // namespace

/// What the scene makes of the simulation: commands that were found possible, so none is refused.
void SceneEdits::execute(const std::vector<simulation::OperatorCommand>& commands) {
  for (const simulation::OperatorCommand& command : commands)
    if (const auto done = drive_.live->command(command); !done) messages_.push_back(describe(done.error()));
}

Expected<void> SceneEdits::begin() {
  if (!drive_.live) return {};
  SolidChange solids = solids_.begin(drive_.store, *drive_.loaded.model, drive_.live->state(), messages_);
  execute(solids.commands);
  solids_.take_over(std::move(solids));
  execute(drive_.standing.begin(drive_.store, *drive_.loaded.model, drive_.live->state(), messages_));
  return {};
}

void SceneEdits::before_tick(const Moment& moment) {
  // A world that stands still shows its tick on, with the changes.
  const Tick from = drive_.live ? drive_.live->state().tick + (moment.doing == "driving" ? 1 : 0) : 0;
  for (SceneRequest& request : host_.take_scene_requests()) {
    if (!drive_.live) {
      host_.refuse_scene(request, "a session that is shown again cannot be changed: edit a drive", moment.now_s);
    } else if (bytes_ahead_ + bytes_of(request) > most_bytes_ahead) {
      host_.refuse_scene(request, "the changes of later ticks fill their queue: send these when it is their time",
                         moment.now_s);
    } else {
      bytes_ahead_ += bytes_of(request);
      const Tick tick = std::max(request.batch.tick, from);
      ahead_.emplace(tick, std::move(request));
    }
  }
  while (!ahead_.empty() && ahead_.begin()->first <= from) {
    SceneRequest request = std::move(ahead_.begin()->second);
    ahead_.erase(ahead_.begin());
    bytes_ahead_ -= bytes_of(request);
    make(std::move(request), from, moment.now_s);
  }
}

void SceneEdits::make(SceneRequest request, Tick from, double now_s) {
  // The list may have changed since it was asked for.
  const auto rights = host_.rights_of(request.editor.name).edit;
  if (!rights) return host_.refuse_scene(request, "the right to edit was taken from this key", now_s);
  put_true_times(drive_.store, request.batch.changes, static_cast<double>(from) / simulation::tick_rate_hz);
  const auto left = without_gone(drive_.store, request.batch.changes, request.editor.own_ids);
  const std::span<const scene::Command> changes = left ? left->commands : request.batch.changes;
  const Editor editor{request.editor.name, *rights, request.editor.own_ids};
  SolidChange solids;
  std::vector<simulation::OperatorCommand> standing;
  const auto accept = [&]() -> std::optional<replication::Failure> {
    auto change = solids_.change(drive_.store, changes, editor, *drive_.loaded.model, drive_.live->state());
    if (!change) return change.error();
    auto shown = drive_.standing.change(drive_.store, changes, *drive_.loaded.model, drive_.live->state());
    if (!shown) return shown.error();
    solids = std::move(*change);
    standing = std::move(*shown);
    return std::nullopt;
  };
  auto refused = pass_gate(
      drive_.store, changes, editor, makers_,
      [&](const scene::Command& command) { host_.scene_changed(command, from); }, accept);
  if (refused) {
    if (left)
      for (replication::Failure& failed : refused->failures) failed.index = left->places[failed.index];
    return host_.refuse_scene(request, std::move(*refused), now_s);
  }
  execute(solids.commands);
  solids_.take_over(std::move(solids));
  execute(standing);
  host_.scene_done(request, from);
  if (log_) log_->session().record_edits(from, changes);
}

void SceneEdits::close(ServeResult&) {
  if (!drive_.generated) return;
  const auto written = document::write_text_file(save_, scene::edits_between(*drive_.generated, drive_.store));
  program::say(written ? fmt::format("What differs from the generated world is in {}", save_.string())
                       : describe(written.error()));
}

void SceneEdits::after_tick(const std::shared_ptr<const TakenSnapshot>& tick, double) {
  if (!drive_.recorded_scene) return;
  const Tick now = tick->snapshot().tick;
  const auto shown = drive_.recorded_scene->advance(
      now, drive_.store, [&](const scene::Command& command) { host_.scene_changed(command, now); });
  if (shown) return;
  messages_.push_back(describe(shown.error()));
  drive_.recorded_scene.reset();
}

}  // namespace septet::server
