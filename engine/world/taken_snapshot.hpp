#pragma once
/// A snapshot that has been taken: const from here on, shared by all who show, send or keep it.
///
/// Its integers are worked out once, by whoever first asks for them. So where nobody but the log wants them, the log's
/// thread does it, and a drive without screens goes on meanwhile. Any number of threads may ask at once.

#include <mutex>

#include "engine/world/wire_snapshot.hpp"

namespace septet {

class TakenSnapshot {
 public:
  explicit TakenSnapshot(Snapshot snapshot);
  /// As it came from a log: its integers are all there is.
  explicit TakenSnapshot(WireSnapshot wire);

  /// Tick, time, state hash and whatever else is not quantised. The participants are there only where it was simulated.
  const Snapshot& snapshot() const { return from_log_ ? wire_.rest : snapshot_; }
  const WireSnapshot& wire() const;

 private:
  const bool from_log_;
  const Snapshot snapshot_;
  mutable std::once_flag quantised_;
  mutable WireSnapshot wire_;  ///< Behind `quantised_`.
};

}  // namespace septet
