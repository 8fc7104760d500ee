#include "sim-server/host/replay_source.hpp"

namespace septet::server {

Expected<std::unique_ptr<ReplaySource>> ReplaySource::start(const logging::SessionReader& session, double from_s) {
  if (auto shown = session.shown_span_s(); !shown) return tl::unexpected(shown.error());
  auto cursor = session.snapshots_from(from_s);
  if (!cursor) return tl::unexpected(cursor.error());
  return std::unique_ptr<ReplaySource>(new ReplaySource(std::move(*cursor), session.info().ticks_per_second));
}

Expected<std::shared_ptr<const TakenSnapshot>> ReplaySource::next(const std::optional<DriverInput>&) {
  auto snapshot = cursor_.next_wire();
  if (!snapshot) return tl::unexpected(snapshot.error());
  if (!*snapshot) return std::shared_ptr<const TakenSnapshot>();
  return std::make_shared<const TakenSnapshot>(std::move(**snapshot));
}

}  // namespace septet::server
