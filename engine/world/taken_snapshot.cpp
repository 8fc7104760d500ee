#include "engine/world/taken_snapshot.hpp"

#include <utility>

namespace septet {
namespace {

constexpr std::size_t most_kept = 64;  ///< Enough for a log that keeps up, and some.

template <class Memory>
Memory take_last(std::vector<Memory>& returned) {
  if (returned.empty()) return {};
  Memory last = std::move(returned.back());
  returned.pop_back();
  return last;
}

}  // namespace

TakenSnapshot::TakenSnapshot(Snapshot snapshot, WireSnapshot memory)
    : from_log_(false), snapshot_(std::move(snapshot)), wire_(std::move(memory)) {}

TakenSnapshot::TakenSnapshot(WireSnapshot wire) : from_log_(true), wire_(std::move(wire)) {}

const WireSnapshot& TakenSnapshot::wire() const {
  if (!from_log_) std::call_once(quantised_, [this] { wire_ = to_wire(snapshot_, std::move(wire_)); });
  return wire_;
}

Snapshot SnapshotMemory::spare() {
  const std::lock_guard lock(returned_->mutex);
  return take_last(returned_->snapshots);
}

std::shared_ptr<const TakenSnapshot> SnapshotMemory::share(Snapshot snapshot) {
  WireSnapshot memory;
  {
    const std::lock_guard lock(returned_->mutex);
    memory = take_last(returned_->wires);
  }
  return {new TakenSnapshot(std::move(snapshot), std::move(memory)), [returned = returned_](TakenSnapshot* taken) {
            const std::unique_ptr<TakenSnapshot> owned(taken);
            const std::lock_guard lock(returned->mutex);
            if (returned->snapshots.size() >= most_kept) return;
            returned->snapshots.push_back(std::move(taken->snapshot_));
            returned->wires.push_back(std::move(taken->wire_));
          }};
}

}  // namespace septet
