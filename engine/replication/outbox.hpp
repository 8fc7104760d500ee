#pragma once
/// Changes not yet sent to one client: subjects in the order in which they first changed.
///
/// A subject waits once, however often it changes, and its commands are written from the store when they are sent: the
/// overwrite-by-address of Brink, Steenberg and Svensson (2006, §2.3.3). Memory is bounded by the number of subjects in
/// the world.

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine/core/bytes.hpp"
#include "engine/replication/subject.hpp"

namespace septet::replication {

class Outbox {
 public:
  /// `tick`: the first that shows it; 0: at once.
  void mark(const Change& change, std::uint64_t tick = 0);
  /// Changes that were sent and did not arrive, in their order: written before all that waits, as they are now, and together
  /// with all that changed up to `tick`.
  void mark_lost(std::span<const Change> lost, std::uint64_t tick);
  /// Drops waiting changes of the subjects from `first` to `last`.
  void forget(const Subject& first, const Subject& last);
  bool empty() const { return waiting_.empty(); }
  /// True where what waits belongs to what was written: a subject is written as it is now, so all that changed up to its last
  /// change's tick belongs to it, as a new node's content to what points at it.
  bool goes_on() const;

  /// True where something that changed up to that tick waits.
  bool waits_for(std::uint64_t tick) const;

  /// Appends commands until `out` holds about `bytes` or no change waits, and appends their subjects to `sent`.
  void write(const scene::Store& store, std::size_t bytes, Bytes& out, std::vector<Change>& sent);

 private:
  struct Waiting {
    Change change;                                                ///< Only the subject counts for a range subject.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> ranges;  ///< [first, end), rising, apart.
    std::uint64_t changed_at = 0;                                 ///< Tick of its last change.
  };

  /// False where the subject waited already.
  bool merge(const Change& change, std::uint64_t tick);
  void write_whole(const scene::Store& store, const Subject& subject, Bytes& out, std::vector<Change>& sent);
  /// Tick of the first that waits; empty: nothing waits.
  std::optional<std::uint64_t> next_tick() const;
  void write_what_it_needs(const scene::Store& store, const Subject& subject, Bytes& out, std::vector<Change>& sent);

  std::map<Subject, Waiting> waiting_;
  std::deque<std::pair<Subject, std::uint64_t>> order_;  ///< With their ticks; may name subjects that no longer wait.
  std::uint64_t written_up_to_ = 0;                      ///< Latest tick of a change that was written.
};

}  // namespace septet::replication
