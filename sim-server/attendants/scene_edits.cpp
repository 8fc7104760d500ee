#include "sim-server/attendants/scene_edits.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>
#include <variant>

#include <fmt/core.h>

#include "engine/core/printable.hpp"
#include "engine/document/text_file.hpp"
#include "engine/scene/edit_file.hpp"
#include "program/console.hpp"
#include "sim-server/drive/operated.hpp"
#include "sim-server/host/serve.hpp"

namespace septet::server {
namespace {

/// Things whose time is over are removed at a tick that was named ahead; that is not the newest thing an editor did.
bool is_end_of_lifetime(const SceneRequest& request) {
  return request.batch.tick > 0 && std::ranges::all_of(request.batch.changes, [](const scene::Command& command) {
           return std::holds_alternative<scene::NodeDestroy>(command);
         });
}

}  // namespace

Expected<void> SceneEdits::begin() {
  std::error_code unknown;
  if (const auto folder = save_.parent_path(); !folder.empty() && !std::filesystem::is_directory(folder, unknown))
    return failure("there is no such folder", save_.string(), "make it, or name another file for --save");
  if (!gate_) return {};
  if (log_) gate_->log_to(log_->session());
  if (host_) gate_->tell([this](const scene::Command& command, Tick from) { host_->scene_changed(command, from); });
  gate_->begin();
  return {};
}

std::vector<std::string> SceneEdits::take_messages() {
  auto messages = std::exchange(messages_, {});
  if (gate_)
    for (std::string& message : gate_->take_messages()) messages.push_back(std::move(message));
  return messages;
}

void SceneEdits::before_tick(const Moment& moment) {
  if (moment.is_being_drawn) return;
  if (gate_) carry_out_storyboard(gate_->shown_from(moment.doing));
  if (host_) take_requests(gate_ ? gate_->shown_from(moment.doing) : 0, moment);
}

void SceneEdits::carry_out_storyboard(Tick from) {
  for (const std::string& line : drive_.live->take_scene_lines())
    if (const auto done = gate_->make_line(the_storyboard(), line, from); !done)
      messages_.push_back(fmt::format("the storyboard's change of the scene is refused ({}): {}", printable(line, 200),
                                      describe(done.error())));
}

void SceneEdits::take_requests(Tick from, const Moment& moment) {
  const double now_s = moment.now_s;
  // Between two ticks of a drive this is called often; a world that stands still has no ticks.
  if (moment.doing != "driving" || from != turns_.tick()) turns_.begin_tick(from);
  for (SceneRequest& request : host_->take_scene_requests()) {
    if (!gate_)
      host_->refuse_scene(request, "a session that is shown again cannot be changed: edit a drive", now_s);
    else if (const auto why_not = turns_.refusal(request))
      host_->refuse_scene(request, *why_not, now_s);
    else
      turns_.add(std::move(request));
  }
  while (const auto request = turns_.next()) make(*request, from, now_s);
}

void SceneEdits::make(const SceneRequest& request, Tick from, double now_s) {
  // The list may have changed since it was asked for.
  const auto rights = host_->rights_of(request.editor.name).edit;
  if (!rights) return host_->refuse_scene(request, "the right to edit was taken from this key", now_s);
  const Editor editor{request.editor.name, *rights, request.editor.own_ids};
  if (auto refused = gate_->make(editor, request.batch.changes, from, !is_end_of_lifetime(request)))
    return host_->refuse_scene(request, std::move(*refused), now_s);
  host_->scene_done(request, from);
}

void SceneEdits::close(ServeResult& result) {
  if (save_.empty() || !drive_.generated) return;
  const auto written = document::write_text_file(save_, scene::edits_between(*drive_.generated, drive_.store));
  if (written)
    program::say(fmt::format("What differs from the generated world is in {}", save_.string()));
  else if (!result.error)
    result.error = written.error();
}

void SceneEdits::after_tick(const std::shared_ptr<const TakenSnapshot>& tick, double) {
  if (!drive_.recorded_scene) return;
  const Tick now = tick->snapshot().tick;
  const auto shown = drive_.recorded_scene->advance(now, drive_.store, [&](const scene::Command& command) {
    if (host_) host_->scene_changed(command, now);
  });
  if (shown) return;
  messages_.push_back(describe(shown.error()));
  drive_.recorded_scene.reset();
}

}  // namespace septet::server
