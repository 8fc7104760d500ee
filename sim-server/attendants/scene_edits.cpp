#include "sim-server/attendants/scene_edits.hpp"

#include "sim-server/drive/scene_gate.hpp"

namespace septet::server {

void SceneEdits::before_tick(const Moment& moment) {
  // A world that stands still shows its tick on, with the changes.
  const Tick from = drive_.live ? drive_.live->state().tick + (moment.doing == "driving" ? 1 : 0) : 0;
  for (const SceneRequest& request : host_.take_scene_requests()) {
    if (!drive_.live) {
      host_.refuse_scene(request, 0, "a session that is shown again cannot be changed: edit a drive", moment.now_s);
      continue;
    }
    const auto refused = pass_gate(drive_.store, request.changes, request.own_ids,
                                   [&](const scene::Command& command) { host_.scene_changed(command, from); });
    if (refused)
      host_.refuse_scene(request, refused->index, refused->why, moment.now_s);
    else if (log_)
      log_->session().record_edits(from, request.changes);
  }
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
