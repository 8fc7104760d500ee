#pragma once
/// The drive's events for clients that hear them: the newest are kept, each hearer is told them in order.

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>

#include "engine/control/control_message.hpp"

namespace septet::server {

/// Events kept for hearers that are late. Of one that is later the older ones are dropped: it sees a gap in the numbers.
inline constexpr std::size_t most_events_kept = 4096;
/// Told to one hearer in one pump, so that a burst does not fill its queue.
inline constexpr std::size_t most_events_per_pump = 64;

class EventFeed {
 public:
  /// Numbers the event.
  void add(control::DriveEvent event);
  /// Events of the drive so far.
  std::uint64_t count() const { return count_; }
  /// The hearer is told all events after those that it returns the count of. Again: nothing is told twice.
  std::uint64_t join(std::uint32_t hearer);
  void leave(std::uint32_t hearer) { told_.erase(hearer); }
  /// Tells each hearer its next ones.
  void pump(const std::function<void(std::uint32_t hearer, const control::DriveEvent&)>& tell);

 private:
  std::deque<control::DriveEvent> kept_;
  std::uint64_t count_ = 0;
  std::map<std::uint32_t, std::uint64_t> told_;  ///< By hearer: the number up to which it has been told.
};

}  // namespace septet::server
