#include "command-line/command/edit/watched_model.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>

#include <fmt/core.h>

#include "engine/core/printable.hpp"
#include "engine/editor/shapes.hpp"
#include "engine/replication/message.hpp"
#include "engine/scene/difference.hpp"

namespace septet::server {
namespace {

constexpr double looks_every_s = 0.2;
/// A file is whole when it has rested that long: programs write large ones in pieces.
constexpr double rests_s = 0.3;

}  // namespace

WatchedModel::Stamp WatchedModel::stamp() const {
  std::error_code error;
  Stamp found;
  found.bytes = std::filesystem::file_size(file_, error);
  if (!error) found.time = std::filesystem::last_write_time(file_, error);
  return error ? Stamp{} : found;
}

Expected<editor::EditedLine> WatchedModel::read() {
  known_ = seen_ = stamp();
  auto model = editor::make_model(name_, file_, transform_, first_);
  if (!model) return tl::unexpected(model.error());
  if (model->next - first_ > watched_ids)
    return failure(
        fmt::format("the model needs {} nodes, and one that is watched may have {}", model->next - first_, watched_ids),
        printable(file_.string()), "join its meshes, or import it without watching");
  scene::Store now;
  for (const scene::Command& command : model->commands)
    if (auto done = now.apply(command); !done) return tl::unexpected(done.error());
  editor::EditedLine line{{}, std::move(model->messages)};
  scene::describe_difference(made_, now, [&](scene::Command command) { line.commands.push_back(std::move(command)); });
  // Nobody may hang a node on another before it is there.
  std::stable_partition(line.commands.begin(), line.commands.end(), [](const scene::Command& command) {
    return std::holds_alternative<scene::NodeCreate>(command);
  });
  made_ = std::move(now);
  return line;
}

bool WatchedModel::is_saved(double now_s) {
  if (now_s - looked_s_ < looks_every_s) return false;
  looked_s_ = now_s;
  const Stamp now = stamp();
  if (now != seen_) {
    seen_ = now;
    rests_since_s_ = now_s;
  }
  if (seen_ == known_ || seen_.bytes == 0 || now_s - rests_since_s_ < rests_s) return false;
  known_ = seen_;
  return true;
}

Expected<WatchedModel> watched_of(const std::vector<scene::TextWord>& words, const scene::Store& store,
                                  editor::EditNames& names) {
  constexpr std::string_view usage = "the line watch NAME FILE.glb [X Y Z [HEADING_DEG]]";
  const auto transform = words.size() >= 3 ? editor::transform_of(std::span(words).subspan(3)) : std::nullopt;
  if (!transform)
    return failure("a name, a file and a place of three or four numbers are needed", std::string(usage),
                   "docs/editing.md shows the lines");
  const std::string& name = words[1].text;
  if (scene::node_of({store, names.own_ids, nullptr, &names.fresh}, {name, true}))
    return failure(fmt::format("there is one called {:.80} already", name), std::string(usage),
                   "remove it first, or take another name");
  if (names.next - names.own_ids + watched_ids > replication::ids_per_session - 2048)
    return failure("this editor has used all its ids", "septet edit", "connect again");
  const scene::NodeId first = names.next;
  names.kept_to = names.next += watched_ids;
  names.objects.insert(first);
  names.fresh[name] = first;
  return WatchedModel(name, words[2].text, *transform, first);
}

}  // namespace septet::server
