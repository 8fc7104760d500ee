#pragma once
/// Where a camera waits whose participant is gone.

#include <optional>

#include "logging/session/session_reader.hpp"
#include "sim-client/film/camera.hpp"

namespace septet::film {

/// The session's world at an instant, also between ticks. Error: the session cannot be read there.
Expected<Snapshot> world_at(const logging::SessionReader& session, double instant_s);

/// Waiting place of the camera for a participant that is gone: from the last tick of the shot that holds them. Reads on
/// as instants ascend. It must not outlive the session.
class LastSeen {
 public:
  static Expected<LastSeen> start(const logging::SessionReader& session, const Shot& shot, const Pivot& pivot);

  /// Viewpoint at an instant not before the previous call's.
  Expected<frame::Viewpoint> at(double instant_s);

 private:
  LastSeen(const Shot& shot, const Pivot& pivot, logging::SnapshotCursor cursor, const frame::Viewpoint& viewpoint);

  Shot shot_;
  Pivot pivot_;
  logging::SnapshotCursor cursor_;
  std::optional<Snapshot> next_;
  frame::Viewpoint viewpoint_;
  bool ended_ = false;
};

}  // namespace septet::film
