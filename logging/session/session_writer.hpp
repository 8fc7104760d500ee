#pragma once
/// Writes a session file (FORMAT.md) without making the simulation wait for the disk.
///
/// Records go into one queue, bounded by its memory; a thread of the writer's own takes them, encodes the snapshots and
/// commits them every `commit_interval`. Killing the process loses uncommitted records: at most 100 ms of wall time. A
/// slow disk drops nothing: once the queue is full, `record` waits, and `waited_s` returns the time.
///
/// Readers change nothing: a program that has the file open, in any transaction, neither stops the recording nor spoils
/// its end.
///
/// Threads: `record` and the queries may be called from any thread. Records of one kind come in ascending ticks.
/// Errors: `create` returns them. Later ones (a full disk, a deleted file) end the recording, not the drive: committed
/// records stay, `take_error` hands the one message over, and further records are counted and not written.

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "engine/core/expected.hpp"
#include "engine/world/taken_snapshot.hpp"
#include "logging/session/records.hpp"

namespace septet::logging {

struct WriterOptions {
  std::size_t queue_bytes = std::size_t{64} << 20;  ///< About a thousand ticks.
  std::chrono::milliseconds commit_interval{50};
  double keyframe_interval_s = 1.0;             ///< Simulated time.
  std::optional<std::uint64_t> max_bytes = {};  ///< Size of the file; reaching it acts like a full disk.
  /// Longest wait for another program's write to the file; meanwhile records wait in the queue.
  std::chrono::milliseconds patience{30'000};
};

class SessionWriter {
 public:
  /// Makes a new file; an existing one is an error, since a log is never overwritten.
  static Expected<SessionWriter> create(const std::filesystem::path& path, const SessionInfo& info,
                                        const WriterOptions& options = {});
  SessionWriter(SessionWriter&&) noexcept;
  SessionWriter& operator=(SessionWriter&&) noexcept;
  /// Writes the queue and closes the file as after a kill; `finish` is the clean end.
  ~SessionWriter();

  /// Stores the first snapshot, and one after each `keyframe_interval_s`, whole, the others as differences.
  void record(std::shared_ptr<const TakenSnapshot> snapshot);
  void record(InputRecord input);
  void record(SceneEdit edit);
  void record(Sample sample);
  void record(Event event);
  void record(QuestionnaireRecord answer);
  void record(StateRecord state);
  void record(ActuatorRecord actuators);

  /// The error that ended the recording, once; empty otherwise.
  std::optional<Error> take_error();
  /// Records not written because the recording had ended.
  std::uint64_t lost_records() const;
  /// Time that `record` has waited for the disk, all calls together.
  double waited_s() const;
  /// Tick of the newest snapshot that is safely in the file.
  std::optional<Tick> committed_tick() const;

  /// Writes the rest, adds rows to `meta`, marks the clean end and leaves one file without side files, unless another
  /// program reads it just then: that is no error. Returns the error that ended the recording unless `take_error` has.
  /// Later records are lost.
  Expected<void> finish(const std::map<std::string, std::string>& meta = {});
  /// After `finish`: another program has the file open, so its side files stay beside it; log and clean end are whole.
  bool is_still_read() const;

 private:
  struct State;
  explicit SessionWriter(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace septet::logging
