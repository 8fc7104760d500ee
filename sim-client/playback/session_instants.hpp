#pragma once
/// World of a session at any instant, also between ticks: the counterpart of a screen's tick lane.

#include "logging/session/session_reader.hpp"
#include "sim-client/frame/playout.hpp"
#include "sim-client/frame/tick_history.hpp"

namespace septet::playback {

/// Reads forward as instants ascend. One thread; must not outlive its reader.
class SessionInstants {
 public:
  /// Starts reading, for instants from `from_s` on.
  static Expected<SessionInstants> start(const logging::SessionReader& session, double from_s);

  /// World at an instant, between its two ticks; not before the previous call's instant. `history()` then holds the
  /// ticks around it, independently of earlier calls.
  Expected<Snapshot> at(double instant_s);
  const frame::TickHistory& history() const { return history_; }
  double tick_s() const { return tick_s_; }

 private:
  SessionInstants(logging::SnapshotCursor cursor, double tick_s) : cursor_(std::move(cursor)), tick_s_(tick_s) {}

  logging::SnapshotCursor cursor_;
  double tick_s_;
  frame::TickHistory history_;
  bool ended_ = false;
};

}  // namespace septet::playback
