#pragma once
/// Reads a session file (FORMAT.md), also one whose writer was killed, and one that is still being written. Neither the
/// file nor its folder is changed: it may belong to another user.
///
/// The file is not trusted: a foreign, newer or damaged one is refused with one Error, at opening or, for damage that
/// only reading meets, at the call that meets it. Memory is bounded by the request. Threads: one thread at a time for a
/// reader; several readers may be open.

#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/world/wire_snapshot.hpp"
#include "logging/session/records.hpp"

namespace septet::logging {

/// Ticks first ≤ tick ≤ last.
struct TickRange {
  Tick first = 0;
  Tick last = std::numeric_limits<std::int64_t>::max();
};

/// Walks through the snapshots of a session. It must not outlive its reader.
class SnapshotCursor {
 public:
  SnapshotCursor(SnapshotCursor&&) noexcept;
  SnapshotCursor& operator=(SnapshotCursor&&) noexcept;
  ~SnapshotCursor();
  /// The next snapshot; empty at the end. After an Error the next call goes on with the next row; behind damage, the
  /// first keyframe decodes again.
  Expected<std::optional<Snapshot>> next();
  /// The same, in its stored form.
  Expected<std::optional<WireSnapshot>> next_wire();

 private:
  friend class SessionReader;
  struct State;
  explicit SnapshotCursor(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

class SessionReader {
 public:
  static Expected<SessionReader> open(const std::filesystem::path& path);
  SessionReader(SessionReader&&) noexcept;
  SessionReader& operator=(SessionReader&&) noexcept;
  ~SessionReader();

  const SessionInfo& info() const;
  const std::filesystem::path& path() const;
  /// True if the writer closed the file itself.
  bool ended_cleanly() const;
  /// Ticks from 0 to the newest without a snapshot: gaps of early builds, or removed rows.
  Expected<std::uint64_t> missing_ticks() const;
  /// Simulated time of the first and last snapshot; empty without a snapshot.
  Expected<std::optional<std::pair<double, double>>> time_span_s() const;
  /// The same for a replay: an Error with the reason if there is nothing to show.
  Expected<std::pair<double, double>> shown_span_s() const;

  /// From the last snapshot at or before this time on; before the first one, from the first.
  Expected<SnapshotCursor> snapshots_from(double simulated_time_s) const;
  Expected<SnapshotCursor> snapshots() const;

  Expected<std::vector<InputRecord>> inputs(TickRange range = {}) const;
  Expected<std::vector<SceneEdit>> scene_edits(TickRange range = {}) const;
  Expected<std::vector<Sample>> samples(TickRange range = {}) const;
  Expected<std::vector<Event>> events(TickRange range = {}) const;
  Expected<std::vector<QuestionnaireRecord>> questionnaire() const;
  /// Empty also in sessions of earlier builds.
  Expected<std::vector<ActuatorRecord>> actuators(TickRange range = {}) const;
  /// Last saved state at or before a tick, if there is one.
  Expected<std::optional<StateRecord>> saved_state(Tick at_or_before) const;
  Expected<std::vector<Tick>> saved_state_ticks() const;

  /// Reads every page of the file; an Error names the damage.
  Expected<void> check_integrity() const;
  /// Reads every row: each value has its column's type, each text is UTF-8. SQLite alone enforces neither.
  Expected<void> check_values() const;

 private:
  struct State;
  explicit SessionReader(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace septet::logging
