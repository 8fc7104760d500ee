#pragma once
/// A taken snapshot: const from here on, shared by all its readers (screens, network, log).
///
/// Its integers are computed once, at the first request. So where the log alone needs them, the log's thread does it,
/// and a drive without screens goes on meanwhile. Thread-safe.

#include <memory>
#include <mutex>

#include "engine/world/wire_snapshot.hpp"

namespace septet {

class TakenSnapshot {
 public:
  explicit TakenSnapshot(Snapshot snapshot, WireSnapshot memory = {});
  /// Makes one from a log: only its integers exist.
  explicit TakenSnapshot(WireSnapshot wire);

  /// Tick, time, state hash and all else that is not quantised. The participants are present only where it was
  /// simulated.
  const Snapshot& snapshot() const { return from_log_ ? wire_.rest : snapshot_; }
  const WireSnapshot& wire() const;

 private:
  friend class SnapshotMemory;
  const bool from_log_;
  Snapshot snapshot_;
  mutable std::once_flag quantised_;
  mutable WireSnapshot wire_;  ///< Behind `quantised_`.
};

/// Memory of released snapshots, for reuse: a tick's 60 KB, allocated by one thread and freed by another 120 times a
/// simulated second, would go back to the system and come again page by page. Any thread may release.
class SnapshotMemory {
 public:
  /// A snapshot to be overwritten; empty where none has come back.
  Snapshot spare();
  std::shared_ptr<const TakenSnapshot> share(Snapshot snapshot);

 private:
  struct Returned {
    std::mutex mutex;
    std::vector<Snapshot> snapshots;  ///< Last in, first out: the last one is the likeliest to be in a cache.
    std::vector<WireSnapshot> wires;
  };
  std::shared_ptr<Returned> returned_ = std::make_shared<Returned>();
};

}  // namespace septet
