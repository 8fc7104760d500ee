#include "sim-client/film/last_seen.hpp"

#include <utility>

#include "sim-client/playback/session_instants.hpp"

namespace septet::film {

Expected<Snapshot> world_at(const logging::SessionReader& session, double instant_s) {
  return playback::SessionInstants::start(session, instant_s).and_then([&](playback::SessionInstants instants) {
    return instants.at(instant_s);
  });
}

Expected<LastSeen> LastSeen::start(const logging::SessionReader& session, const Shot& shot, const Pivot& pivot) {
  const auto world = world_at(session, shot.from_s);
  if (!world) return tl::unexpected(world.error());
  auto cursor = session.snapshots_from(shot.from_s);
  if (!cursor) return tl::unexpected(cursor.error());
  return LastSeen(shot, pivot, std::move(*cursor), viewpoint_at(shot, pivot, *world, {}));
}

LastSeen::LastSeen(const Shot& shot, const Pivot& pivot, logging::SnapshotCursor cursor,
                   const frame::Viewpoint& viewpoint)
    : shot_(shot), pivot_(pivot), cursor_(std::move(cursor)), viewpoint_(viewpoint) {}

Expected<frame::Viewpoint> LastSeen::at(double instant_s) {
  while (!ended_ && (!next_ || next_->simulated_time_s <= instant_s)) {
    if (next_) viewpoint_ = viewpoint_at(shot_, pivot_, *next_, viewpoint_);
    auto next = cursor_.next();
    if (!next) return tl::unexpected(next.error());
    next_ = std::move(*next);
    ended_ = !next_.has_value();
  }
  return viewpoint_;
}

}  // namespace septet::film
