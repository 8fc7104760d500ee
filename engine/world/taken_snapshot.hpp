#pragma once
/// A snapshot that has been taken: const from here on, shared by all who show, send or keep it.
///
/// Its integers are worked out once, by whoever first asks for them. So where nobody but the log wants them, the log's
/// thread does it, and a drive without screens goes on meanwhile. Any number of threads may ask at once.

#include <memory>
#include <mutex>

#include "engine/world/wire_snapshot.hpp"

namespace septet {

class TakenSnapshot {
 public:
  explicit TakenSnapshot(Snapshot snapshot, WireSnapshot memory = {});
  /// As it came from a log: its integers are all there is.
  explicit TakenSnapshot(WireSnapshot wire);

  /// Tick, time, state hash and whatever else is not quantised. The participants are there only where it was simulated.
  const Snapshot& snapshot() const { return from_log_ ? wire_.rest : snapshot_; }
  const WireSnapshot& wire() const;

 private:
  friend class SnapshotMemory;
  const bool from_log_;
  Snapshot snapshot_;
  mutable std::once_flag quantised_;
  mutable WireSnapshot wire_;  ///< Behind `quantised_`.
};

/// The memory of snapshots that nobody holds any more, for those to come: a tick's 60 KB, allocated by one thread and freed
/// by another 120 times a simulated second, would go back to the system and come again page by page. Any thread may let go.
class SnapshotMemory {
 public:
  /// A snapshot to be written over; empty where none has come back.
  Snapshot spare();
  std::shared_ptr<const TakenSnapshot> share(Snapshot snapshot);

 private:
  struct Returned {
    std::mutex mutex;
    std::vector<Snapshot> snapshots;  ///< The last one was used last: it is the likeliest to be in a cache.
    std::vector<WireSnapshot> wires;
  };
  std::shared_ptr<Returned> returned_ = std::make_shared<Returned>();
};

}  // namespace septet
