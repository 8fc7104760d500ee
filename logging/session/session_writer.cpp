#include "logging/session/session_writer.hpp"

#include <sys/stat.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/core.h>

#include "engine/core/bounded_queue.hpp"
#include "engine/core/check.hpp"
#include "logging/session/packed_snapshot.hpp"
#include "logging/session/record_tables.hpp"
#include "logging/session/scene_runs.hpp"
#include "logging/session/schema.hpp"
#include "logging/session/sqlite_database.hpp"

namespace septet::logging {
namespace {

using Clock = std::chrono::steady_clock;
using Record = std::variant<std::shared_ptr<const TakenSnapshot>, InputRecord, SceneEdit, Sample, Event,
                            QuestionnaireRecord, StateRecord, ActuatorRecord>;

/// The memory that a record keeps while it is queued, roughly.
std::size_t bytes_of(const Record& record) {
  struct Extra {
    std::size_t operator()(const std::shared_ptr<const TakenSnapshot>& taken) const {
      const Snapshot& snapshot = taken->snapshot();
      std::size_t bytes =
          sizeof(TakenSnapshot) + snapshot.participants.capacity() * (sizeof(Participant) + sizeof(WireParticipant));
      for (const EffectKeyframe& effect : snapshot.effects) bytes += 2 * (sizeof effect + effect.data.size());
      return bytes;
    }
    std::size_t operator()(const InputRecord&) const { return 0; }
    std::size_t operator()(const SceneEdit& edit) const { return edit.command.capacity(); }
    std::size_t operator()(const Sample&) const { return 0; }
    std::size_t operator()(const Event& event) const { return event.detail.capacity(); }
    std::size_t operator()(const QuestionnaireRecord&) const { return 0; }
    std::size_t operator()(const StateRecord& state) const { return state.data.capacity(); }
    std::size_t operator()(const ActuatorRecord&) const { return 0; }
  };
  return sizeof record + std::visit(Extra{}, record);
}

/// Identity of the file at a path; empty without a file.
std::optional<std::pair<dev_t, ino_t>> file_at(const std::filesystem::path& path) {
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0) return std::nullopt;
  return std::pair(found.st_dev, found.st_ino);
}

/// Executes it; while another connection blocks it, retries up to the limit.
Expected<void> execute_patiently(const Database& database, const std::string& sql, std::chrono::milliseconds patience) {
  constexpr std::chrono::milliseconds pause{20};
  const Clock::time_point last = Clock::now() + patience;
  for (;;) {
    auto done = database.execute(sql);
    if (done || !database.is_busy() || Clock::now() >= last) return done;
    std::this_thread::sleep_for(pause);
  }
}

Expected<Database> create_database(const std::filesystem::path& path, const SessionInfo& info,
                                   const WriterOptions& options) {
  auto database = Database::open(path, OpenMode::create);
  if (!database) return database;
  const std::string mode = fmt::format(
      "PRAGMA page_size={}; PRAGMA application_id={}; PRAGMA user_version={}; PRAGMA journal_mode=WAL; "
      "PRAGMA synchronous=FULL; PRAGMA locking_mode=NORMAL",
      page_bytes, application_id, format_version);
  std::string schema;
  for (const Table& table : tables) schema += fmt::format("{}; ", table.sql);
  for (const Table& table : later_tables) schema += fmt::format("{}; ", table.sql);
  schema += keyframe_index;
  // A reader that looks just then holds the file for a moment.
  if (auto done = execute_patiently(*database, mode, options.patience); !done) return tl::unexpected(done.error());
  if (auto done = execute_patiently(*database, "BEGIN IMMEDIATE", options.patience); !done)
    return tl::unexpected(done.error());
  if (auto done = database->execute(schema); !done) return tl::unexpected(done.error());
  if (auto done = insert_info(*database, info); !done) return tl::unexpected(done.error());
  if (auto done = database->execute("COMMIT"); !done) return tl::unexpected(done.error());
  if (options.max_bytes) {
    const std::uint64_t pages = *options.max_bytes / page_bytes;
    if (auto done = database->execute(fmt::format("PRAGMA max_page_count={}", pages)); !done)
      return tl::unexpected(done.error());
  }
  return database;
}

}  // namespace

/// State shared by both sides. `queue` and the atomics are for both, `error` is behind its mutex, and everything under
/// "the writer's thread" belongs to it between construction and join.
struct SessionWriter::State {
  State(Database database_in, InsertStatements inserts_in, const WriterOptions& options_in)
      : options(options_in),
        queue(options_in.queue_bytes),
        database(std::move(database_in)),
        inserts(std::move(inserts_in)),
        file(file_at(database.where())) {
    thread = std::thread([this] { run(); });
  }
  ~State() { stop(); }

  void stop() {
    queue.close();
    if (thread.joinable()) thread.join();
  }

  void push(Record record) {
    const std::size_t bytes = bytes_of(record);
    if (queue.try_push(record, bytes)) return;
    const Clock::time_point begun = Clock::now();
    if (!queue.push(record, bytes)) lost.fetch_add(1, std::memory_order_relaxed);
    waited_ns.fetch_add((Clock::now() - begun).count(), std::memory_order_relaxed);
  }

  void run() {
    // Taken in small batches while they are in the processor's cache, committed by the clock.
    constexpr std::size_t batch_records = 32;
    std::vector<Record> batch;
    // Scheduled from commit to commit, so that a commit's duration is part of the interval.
    Clock::time_point next_commit = Clock::now() + options.commit_interval;
    while (queue.take_all(batch, next_commit, batch_records)) {
      if (!batch.empty()) write(batch);
      const Clock::time_point now = Clock::now();
      if (now < next_commit) continue;
      next_commit = now + options.commit_interval;
      commit();
    }
    commit();
  }

  void write(const std::vector<Record>& batch);
  void commit();
  void fail(Error reason);
  Expected<void> write_all(const std::vector<Record>& batch);
  Expected<void> write_snapshot(const std::shared_ptr<const TakenSnapshot>& taken);
  Expected<void> write_edit(const SceneEdit& edit);
  Expected<void> write_run();
  Expected<void> check_file() const;
  Expected<void> join_side_files();

  const WriterOptions options;
  BoundedQueue<Record> queue;
  std::atomic<std::uint64_t> lost{0};
  std::atomic<std::int64_t> waited_ns{0};
  std::atomic<std::int64_t> committed{-1};
  std::mutex error_mutex;
  std::optional<Error> error;

  // The writer's thread.
  Database database;
  InsertStatements inserts;
  const std::optional<std::pair<dev_t, ino_t>> file;  ///< The created file.
  std::shared_ptr<const TakenSnapshot> previous;
  double keyframe_time_s = 0.0;
  std::size_t uncommitted = 0;  ///< Records of the transaction that is open.
  bool has_failed = false;
  bool is_finished = false;
  bool is_still_read = false;
  SnapshotPacker packer;
  SceneRunPacker scene_run;  ///< Of the transaction that is open.
  Bytes encoded;

  std::thread thread;
};

void SessionWriter::State::write(const std::vector<Record>& batch) {
  if (has_failed) {
    lost.fetch_add(batch.size(), std::memory_order_relaxed);
    return;
  }
  // Begins as a writer: a blocking connection is met here, where waiting loses nothing, and nowhere else.
  auto done = uncommitted == 0 ? execute_patiently(database, "BEGIN IMMEDIATE", options.patience) : Expected<void>{};
  uncommitted += batch.size();
  if (done) done = write_all(batch);
  if (!done) fail(std::move(done.error()));
}

void SessionWriter::State::commit() {
  if (has_failed) return;
  // Checked without new records too, so that callers learn that the file is gone.
  auto done = check_file();
  if (done) done = write_run();
  if (done && uncommitted > 0) done = database.execute("COMMIT");
  if (!done) return fail(std::move(done.error()));
  uncommitted = 0;
  if (previous) committed.store(static_cast<std::int64_t>(previous->snapshot().tick), std::memory_order_release);
}

void SessionWriter::State::fail(Error reason) {
  // The transaction is undone as a whole; earlier ones stay.
  if (database.in_transaction()) (void)database.execute("ROLLBACK");
  lost.fetch_add(std::exchange(uncommitted, 0), std::memory_order_relaxed);
  has_failed = true;
  queue.close();
  const std::lock_guard lock(error_mutex);
  error = std::move(reason);
}

Expected<void> SessionWriter::State::write_all(const std::vector<Record>& batch) {
  struct Insert {
    State& state;
    Expected<void> operator()(const std::shared_ptr<const TakenSnapshot>& record) {
      return state.write_snapshot(record);
    }
    Expected<void> operator()(const InputRecord& record) {
      if (auto done = insert(state.inserts.input, record); !done) return done;
      return insert_head(state.inserts.head, record);
    }
    Expected<void> operator()(const SceneEdit& record) { return state.write_edit(record); }
    Expected<void> operator()(const Sample& record) { return insert(state.inserts.sample, record); }
    Expected<void> operator()(const Event& record) { return insert(state.inserts.event, record); }
    Expected<void> operator()(const QuestionnaireRecord& record) { return insert(state.inserts.answer, record); }
    Expected<void> operator()(const StateRecord& record) { return insert(state.inserts.state, record); }
    Expected<void> operator()(const ActuatorRecord& record) { return insert(state.inserts.actuators, record); }
  };
  for (const Record& record : batch)
    if (auto done = std::visit(Insert{*this}, record); !done) return done;
  return {};
}

Expected<void> SessionWriter::State::write_snapshot(const std::shared_ptr<const TakenSnapshot>& taken) {
  const Snapshot& rest = taken->snapshot();
  SEPTET_CHECK(!previous || rest.tick > previous->snapshot().tick, "snapshot {} after {}", rest.tick,
               previous->snapshot().tick);
  const bool is_keyframe = !previous || rest.simulated_time_s >= keyframe_time_s + options.keyframe_interval_s;
  if (is_keyframe) keyframe_time_s = rest.simulated_time_s;
  encoded.clear();
  packer.pack(taken->wire(), is_keyframe ? nullptr : &previous->wire(), encoded);
  Statement& statement = inserts.snapshot;
  statement.bind(1, static_cast<std::int64_t>(rest.tick));
  statement.bind(2, rest.simulated_time_s);
  is_keyframe ? statement.bind_null(3) : statement.bind(3, static_cast<std::int64_t>(previous->snapshot().tick));
  statement.bind(4, static_cast<std::int64_t>(rest.state_hash));
  statement.bind(5, std::span<const std::byte>(encoded));
  previous = taken;
  return statement.run();
}

Expected<void> SessionWriter::State::write_edit(const SceneEdit& edit) {
  auto done = scene_run.has_room_for(edit) ? Expected<void>{} : write_run();
  if (done) scene_run.add(edit);
  return done;
}

Expected<void> SessionWriter::State::write_run() {
  if (scene_run.is_empty()) return {};
  const SceneRun run = scene_run.take();
  auto done = insert(inserts.scene_run, run);
  if (done) done = insert_fingerprints(inserts.fingerprints, run);
  return done;
}

/// Writes to a deleted open file succeed silently, and are lost in the end.
Expected<void> SessionWriter::State::check_file() const {
  if (file_at(database.where()) == file && file_at(database.where() + "-wal")) return {};
  return failure("the session file was deleted or moved, or its disk has gone, while it was written", database.where(),
                 "leave the folder alone until the drive is over, and drive again");
}

/// Commits are safe in either file. Joining them needs the only connection, and a reader cannot be made to leave;
/// readers that come and go leave a gap.
Expected<void> SessionWriter::State::join_side_files() {
  constexpr std::chrono::milliseconds for_a_gap{1000};
  auto done = database.execute("PRAGMA wal_checkpoint(TRUNCATE)");
  if (done) done = execute_patiently(database, "PRAGMA journal_mode=DELETE", for_a_gap);
  is_still_read = !done && database.is_busy();
  return is_still_read ? Expected<void>{} : done;
}

Expected<SessionWriter> SessionWriter::create(const std::filesystem::path& path, const SessionInfo& info,
                                              const WriterOptions& options) {
  SEPTET_CHECK(options.queue_bytes > 0, "a queue of {} bytes", options.queue_bytes);
  auto database = create_database(path, info, options);
  if (!database) return tl::unexpected(database.error());
  auto inserts = prepare_inserts(*database);
  if (!inserts) return tl::unexpected(inserts.error());
  return SessionWriter(std::make_unique<State>(std::move(*database), std::move(*inserts), options));
}

SessionWriter::SessionWriter(std::unique_ptr<State> state) : state_(std::move(state)) {}
SessionWriter::SessionWriter(SessionWriter&&) noexcept = default;
SessionWriter& SessionWriter::operator=(SessionWriter&&) noexcept = default;
SessionWriter::~SessionWriter() = default;

void SessionWriter::record(std::shared_ptr<const TakenSnapshot> snapshot) { state_->push(std::move(snapshot)); }
void SessionWriter::record(InputRecord input) { state_->push(std::move(input)); }
void SessionWriter::record(SceneEdit edit) { state_->push(std::move(edit)); }
void SessionWriter::record(Sample sample) { state_->push(sample); }
void SessionWriter::record(Event event) { state_->push(std::move(event)); }
void SessionWriter::record(QuestionnaireRecord answer) { state_->push(std::move(answer)); }
void SessionWriter::record(StateRecord state) { state_->push(std::move(state)); }
void SessionWriter::record(ActuatorRecord record) { state_->push(record); }

std::optional<Error> SessionWriter::take_error() {
  const std::lock_guard lock(state_->error_mutex);
  return std::exchange(state_->error, std::nullopt);
}

std::uint64_t SessionWriter::lost_records() const { return state_->lost.load(std::memory_order_relaxed); }

double SessionWriter::waited_s() const {
  return 1e-9 * static_cast<double>(state_->waited_ns.load(std::memory_order_relaxed));
}

std::optional<Tick> SessionWriter::committed_tick() const {
  const std::int64_t tick = state_->committed.load(std::memory_order_acquire);
  return tick < 0 ? std::nullopt : std::optional(static_cast<Tick>(tick));
}

Expected<void> SessionWriter::finish(const std::map<std::string, std::string>& meta) {
  state_->stop();
  if (state_->is_finished) return {};
  state_->is_finished = true;
  if (state_->has_failed) {
    if (auto error = take_error()) return tl::unexpected(std::move(*error));
    return {};
  }
  const Database& database = state_->database;
  auto done = execute_patiently(database, "BEGIN IMMEDIATE", state_->options.patience);
  for (const auto& [key, value] : meta)
    if (done) done = insert_meta(database, key, value);
  if (done) done = insert_meta(database, "ended", "1");
  if (done && state_->previous)
    done = insert_meta(database, "ended_simulated_time_s",
                       fmt::format("{}", state_->previous->snapshot().simulated_time_s));
  if (done) done = database.execute("COMMIT");
  return done ? state_->join_side_files() : done;
}

bool SessionWriter::is_still_read() const { return state_->is_still_read; }

}  // namespace septet::logging
