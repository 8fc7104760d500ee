#include "sim-client/frame/tick_history.hpp"

#include <algorithm>

namespace septet::frame {

const HistoryTick* TickHistory::find(Tick tick) const {
  const auto found =
      std::ranges::lower_bound(ticks_, tick, {}, [](const HistoryTick& entry) { return entry.snapshot.tick; });
  return found != ticks_.end() && found->snapshot.tick == tick ? &*found : nullptr;
}

TickHistory::Outcome TickHistory::add(std::span<const std::byte> payload) {
  ByteReader reader(payload);
  HistoryTick entry;
  entry.header = control::get_tick_header(reader);
  if (!reader.ok()) {
    error_ = {"malformed header", "tick lane", "run the same version of Septet on all machines"};
    return Outcome::refused;
  }
  const auto bytes = reader.take(reader.remaining());
  const auto header = read_snapshot_header(bytes);
  if (!header) {
    error_ = header.error();
    return Outcome::refused;
  }
  if (find(header->tick)) return Outcome::stored;
  const HistoryTick* baseline = header->baseline ? find(*header->baseline) : nullptr;
  if (header->baseline && !baseline) return Outcome::lost_baseline;
  auto wire = decode_snapshot(bytes, baseline ? &baseline->wire : nullptr);
  if (!wire) {
    error_ = wire.error();
    return Outcome::refused;
  }
  entry.wire = std::move(*wire);
  entry.snapshot = from_wire(entry.wire);
  add(std::move(entry));
  return Outcome::stored;
}

void TickHistory::add(HistoryTick entry) {
  const auto place = std::ranges::upper_bound(ticks_, entry.snapshot.tick, {},
                                              [](const HistoryTick& old) { return old.snapshot.tick; });
  ticks_.insert(place, std::move(entry));
  if (ticks_.size() > kept) ticks_.pop_front();
}

void TickHistory::forget_before(double simulated_time_s) {
  while (ticks_.size() > 1 && ticks_[1].snapshot.simulated_time_s <= simulated_time_s) ticks_.pop_front();
}

TickHistory::Neighbours TickHistory::around(double simulated_time_s) const {
  const auto after = std::ranges::upper_bound(ticks_, simulated_time_s, {},
                                              [](const HistoryTick& entry) { return entry.snapshot.simulated_time_s; });
  Neighbours neighbours;
  if (after != ticks_.end()) neighbours.after = &*after;
  if (after != ticks_.begin()) neighbours.before = &*std::prev(after);
  return neighbours;
}

}  // namespace septet::frame
