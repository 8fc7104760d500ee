#include "sim-client/playback/session_instants.hpp"

#include <algorithm>

namespace septet::playback {
namespace {

// Effects have keyframes every few ticks: with these on both sides an instant lies between two of them.
constexpr double ticks_ahead = 8.0, ticks_before = 32.0;

}  // namespace

Expected<SessionInstants> SessionInstants::start(const logging::SessionReader& session, double from_s) {
  const double tick_s = 1.0 / session.info().ticks_per_second;
  auto cursor = session.snapshots_from(std::max(0.0, from_s - ticks_before * tick_s));
  if (!cursor) return tl::unexpected(cursor.error());
  return SessionInstants(std::move(*cursor), tick_s);
}

Expected<Snapshot> SessionInstants::at(double instant_s) {
  while (!ended_ &&
         (history_.empty() || history_.newest().snapshot.simulated_time_s < instant_s + ticks_ahead * tick_s_)) {
    auto next = cursor_.next();
    if (!next) return tl::unexpected(next.error());
    ended_ = !next->has_value();
    if (!ended_) history_.add({.snapshot = std::move(**next)});
  }
  // Ticks further back than `start` reads are dropped, so that the ticks around an instant are independent of earlier
  // calls.
  history_.forget_before(instant_s - ticks_before * tick_s_);
  if (history_.empty()) return failure("the session ends before it", "instant", "choose instants within the session");
  return frame::show(history_, instant_s, tick_s_).snapshot;
}

}  // namespace septet::playback
