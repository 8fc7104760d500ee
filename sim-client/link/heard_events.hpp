#pragma once
/// The drive's events as a client hears them: in order, with a count of those that were dropped on the way.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "engine/control/control_message.hpp"

namespace septet::screen {

/// Events kept for a reader that takes none; further ones are dropped and counted.
inline constexpr std::size_t most_heard_events = 10'000;

class HeardEvents {
 public:
  /// The server's reply: the first time, or after the connection was lost. A server that has had fewer is another one.
  void begin(std::uint64_t count);
  void take(control::DriveEvent event);
  /// The connection is lost: what happens until the next reply is counted as dropped.
  void lose() { is_heard_ = false; }
  /// True if this many events of the drive, and so all of a tick with that count, are here.
  bool has(std::uint64_t count) const { return is_heard_ && number_ && *number_ >= count; }
  std::vector<control::DriveEvent> take_all() { return std::exchange(events_, {}); }
  std::uint64_t take_dropped() { return std::exchange(dropped_, 0); }

 private:
  bool is_heard_ = false;
  std::optional<std::uint64_t> number_;  ///< Up to which all are here or counted as dropped.
  std::vector<control::DriveEvent> events_;
  std::uint64_t dropped_ = 0;
};

}  // namespace septet::screen
