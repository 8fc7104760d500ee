#include "engine/world/taken_snapshot.hpp"

#include <utility>

namespace septet {

TakenSnapshot::TakenSnapshot(Snapshot snapshot) : from_log_(false), snapshot_(std::move(snapshot)) {}

TakenSnapshot::TakenSnapshot(WireSnapshot wire) : from_log_(true), wire_(std::move(wire)) {}

const WireSnapshot& TakenSnapshot::wire() const {
  if (!from_log_) std::call_once(quantised_, [this] { wire_ = to_wire(snapshot_); });
  return wire_;
}

}  // namespace septet
