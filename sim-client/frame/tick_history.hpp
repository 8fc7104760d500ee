#pragma once
/// Decoded ticks that a screen has received, or a film has read: baselines for the next ones, and the source of
/// interpolation.
///
/// Independent of sockets and clocks, so that tests can feed it from a bad network on simulated time. One thread.

#include <deque>
#include <optional>
#include <span>

#include "engine/control/control_message.hpp"
#include "engine/core/expected.hpp"
#include "engine/world/wire_snapshot.hpp"

namespace septet::frame {

struct HistoryTick {
  control::TickHeader header;
  WireSnapshot wire;
  Snapshot snapshot;
};

class TickHistory {
 public:
  static constexpr std::size_t kept = 96;  ///< Number of ticks kept, at least that of net::BaselineOptions.

  enum class Outcome : std::uint8_t { stored, lost_baseline, refused };
  /// Adds one tick's payload as received on the tick lane; `error()` holds the reason of a refusal.
  Outcome add(std::span<const std::byte> payload);
  const Error& error() const { return error_; }
  /// Adds one tick that is decoded already, as a session's is.
  void add(HistoryTick entry);
  /// Drops ticks older than the last one at or before this simulated time.
  void forget_before(double simulated_time_s);
  /// Drops everything: the server was restarted.
  void clear() { ticks_.clear(); }

  bool empty() const { return ticks_.empty(); }
  const HistoryTick& newest() const { return ticks_.back(); }
  const HistoryTick* find(Tick tick) const;
  const std::deque<HistoryTick>& ticks() const { return ticks_; }  ///< Ascending.

  /// Ticks around a simulated time: the last one at or before it and the first one after it (either may be null).
  struct Neighbours {
    const HistoryTick* before = nullptr;
    const HistoryTick* after = nullptr;
  };
  Neighbours around(double simulated_time_s) const;

 private:
  std::deque<HistoryTick> ticks_;  ///< Ascending tick.
  Error error_;
};

}  // namespace septet::frame
