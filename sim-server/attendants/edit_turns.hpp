#pragma once
/// Whose batch of scene changes is done next: of each editor some work a tick, of all together some more, by turns. What
/// is over it waits in its editor's own queue of bounded size; so one that floods keeps neither the drive nor the others
/// waiting. Work is counted in commands and bytes, never by a clock: the same requests are done at the same ticks.
///
/// A batch stays whole. One of more work than a tick's share, up to replication::most_changes_of_batch, is done at once, and its
/// editor's next ones wait until the ticks since would have had room for it.

#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <string>

#include "engine/replication/message.hpp"
#include "sim-server/host/screen_host.hpp"

namespace septet::server {

/// A command is a piece of work, and so are each 8 KiB of a batch: the largest batch of content is one tick's. Five times
/// a script that moves fifty things each tick; a flood of 10^5 commands a second is three times as many.
inline constexpr std::size_t most_edit_work_a_tick = 256, bytes_of_edit_work = 8192;
static_assert(most_edit_work_a_tick * bytes_of_edit_work == replication::max_batch_bytes);
/// Of all editors: four of them need not wait for each other.
inline constexpr std::size_t most_edit_work_of_all_a_tick = 4 * most_edit_work_a_tick;
/// Of one editor's batches that wait, for a tick that they name or for their turn: what one fills is no other's.
inline constexpr std::size_t most_edit_bytes_waiting = 64u << 20;
/// How far ahead a batch may name its tick: a million seconds, the longest lifetime.
inline constexpr Tick most_ticks_ahead = 120'000'000;

class EditTurns {
 public:
  /// A new tick's work begins: `from` is the first tick that shows it. Also each time that a world which stands still is
  /// looked at, with the same tick.
  void begin_tick(Tick from);
  Tick tick() const { return from_; }
  /// Why the request may not wait: its editor's queue is full, or the tick that it names is too far ahead.
  std::optional<std::string> refusal(const SceneRequest& request) const;
  /// It is due at once, or at the tick that it names.
  void add(SceneRequest request);
  /// The next request whose turn is in this tick, if any.
  std::optional<SceneRequest> next();

 private:
  struct Queue {
    std::deque<SceneRequest> due;
    std::multimap<Tick, SceneRequest> later;  ///< By the tick that is to show them first.
    std::size_t bytes = 0;                    ///< Of both.
    std::size_t work = 0;                     ///< Done, as far as this tick and those before it had no room for it.
  };

  std::map<std::string, Queue> queues_;  ///< By the names of the editors' keys.
  std::string last_;                     ///< Whose turn was last.
  std::size_t work_ = 0;                 ///< Of all, in this tick.
  Tick from_ = 0;
};

}  // namespace septet::server
