#include "logging/session/session_reader.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/core.h>

#include "logging/session/packed_snapshot.hpp"
#include "logging/session/record_tables.hpp"
#include "logging/session/schema.hpp"
#include "logging/session/session_checks.hpp"
#include "logging/session/sqlite_database.hpp"

namespace septet::logging {
namespace {

template <class T>
Expected<std::vector<T>> read_rows(Expected<Statement> statement, Expected<T> (*read)(const Statement&)) {
  if (!statement) return tl::unexpected(statement.error());
  std::vector<T> rows;
  for (;;) {
    const auto row = statement->step();
    if (!row) return tl::unexpected(row.error());
    if (!*row) return rows;
    auto value = read(*statement);
    if (!value) return tl::unexpected(value.error());
    rows.push_back(std::move(*value));
  }
}

/// The tick that a query returns; empty without a row.
template <class... Parameter>
Expected<std::optional<std::int64_t>> query_tick(const Database& database, std::string_view sql,
                                                 Parameter... parameters) {
  auto statement = database.prepare(sql);
  if (!statement) return tl::unexpected(statement.error());
  int index = 1;
  (statement->bind(index++, parameters), ...);
  const auto row = statement->step();
  if (!row) return tl::unexpected(row.error());
  return *row && !statement->is_null(0) ? std::optional(statement->integer(0)) : std::nullopt;
}

/// For tables that files of earlier builds lack.
Expected<bool> has_table_called(const Database& database, std::string_view name) {
  return database
      .query_integer(fmt::format("SELECT count(*) FROM sqlite_schema WHERE type = 'table' AND name = '{}'", name))
      .transform([](std::int64_t count) { return count > 0; });
}

Expected<Statement> prepare_range(const Database& database, std::string_view columns, std::string_view table,
                                  TickRange range, std::string_view order) {
  auto statement =
      database.prepare(fmt::format("SELECT {} FROM {} WHERE tick BETWEEN ? AND ? ORDER BY {}", columns, table, order));
  if (statement) {
    constexpr auto most = static_cast<Tick>(std::numeric_limits<std::int64_t>::max());
    statement->bind(1, static_cast<std::int64_t>(std::min(range.first, most)));
    statement->bind(2, static_cast<std::int64_t>(std::min(range.last, most)));
  }
  return statement;
}

}  // namespace

struct SessionReader::State {
  Database database;
  SessionInfo info;
  std::filesystem::path path;
  bool ended_cleanly = false;
};

struct SnapshotCursor::State {
  Statement rows;
  std::string where;
  SnapshotUnpacker unpacker;
  std::optional<WireSnapshot> previous;
  std::optional<WireSnapshot> ready;  ///< Decoded on the path to the requested time.
  bool ended = false;                 ///< Another step would start over.
};

SnapshotCursor::SnapshotCursor(std::unique_ptr<State> state) : state_(std::move(state)) {}
SnapshotCursor::SnapshotCursor(SnapshotCursor&&) noexcept = default;
SnapshotCursor& SnapshotCursor::operator=(SnapshotCursor&&) noexcept = default;
SnapshotCursor::~SnapshotCursor() = default;

Expected<std::optional<WireSnapshot>> SnapshotCursor::next_wire() {
  if (state_->ready) return std::exchange(state_->ready, std::nullopt);
  if (state_->ended) return std::optional<WireSnapshot>();
  Statement& rows = state_->rows;
  const auto row = rows.step();
  if (!row) return tl::unexpected(row.error());
  state_->ended = !*row;
  if (state_->ended) return std::optional<WireSnapshot>();
  const auto tick = static_cast<Tick>(rows.integer(0));
  const auto damaged = [&](std::string_view what) {
    return failure(fmt::format("snapshot {} is damaged: {}", tick, what), state_->where,
                   "replay up to the tick before it, or use a copy of the file");
  };
  const auto bytes = rows.blob(1);
  const auto header = read_stored_header(bytes);
  if (!header) return damaged(header.error().what);
  if (header->tick != tick) return damaged(fmt::format("its bytes are those of tick {}", header->tick));
  if (header->baseline.has_value() == rows.is_null(4)) return damaged("its row and its bytes name two baselines");
  const auto& previous = state_->previous;
  if (header->baseline && *header->baseline < tick && (!previous || previous->rest.tick < *header->baseline))
    return failure(fmt::format("the snapshot of tick {} is missing: the log has a gap", *header->baseline),
                   state_->where, "replay up to the tick before it, or use a copy of the file");
  if (header->baseline && (!previous || previous->rest.tick != *header->baseline))
    return damaged(fmt::format("it is a difference to tick {}, which is not the row before", *header->baseline));
  auto snapshot = state_->unpacker.unpack(bytes, header->baseline ? &*previous : nullptr);
  if (!snapshot) return damaged(snapshot.error().what);
  if (snapshot->rest.simulated_time_s != rows.real(3)) return damaged("its row and its bytes name two times");
  state_->previous = *snapshot;
  // The row's own hash is the recorded one, for comparison; a changed hash is an altered session.
  snapshot->rest.state_hash = static_cast<std::uint64_t>(rows.integer(2));
  return std::optional(std::move(*snapshot));
}

Expected<std::optional<Snapshot>> SnapshotCursor::next() {
  auto wire = next_wire();
  if (!wire) return tl::unexpected(wire.error());
  return *wire ? std::optional(from_wire(**wire)) : std::nullopt;
}

SessionReader::SessionReader(std::unique_ptr<State> state) : state_(std::move(state)) {}
SessionReader::SessionReader(SessionReader&&) noexcept = default;
SessionReader& SessionReader::operator=(SessionReader&&) noexcept = default;
SessionReader::~SessionReader() = default;

Expected<SessionReader> SessionReader::open(const std::filesystem::path& path) {
  auto database = Database::open(path, OpenMode::read);
  if (!database) return tl::unexpected(database.error());
  if (auto checked = check_format(*database); !checked) return tl::unexpected(checked.error());
  auto info = read_info(*database);
  if (!info) return tl::unexpected(info.error());
  const bool ended = info->other.contains("ended");
  return SessionReader(std::make_unique<State>(State{std::move(*database), std::move(*info), path, ended}));
}

const SessionInfo& SessionReader::info() const { return state_->info; }
const std::filesystem::path& SessionReader::path() const { return state_->path; }
bool SessionReader::ended_cleanly() const { return state_->ended_cleanly; }

Expected<std::uint64_t> SessionReader::missing_ticks() const {
  return state_->database.query_integer("SELECT ifnull(max(tick) + 1, 0) - count(*) FROM snapshots WHERE tick >= 0")
      .map([](std::int64_t missing) { return static_cast<std::uint64_t>(missing); });
}

Expected<std::optional<std::pair<double, double>>> SessionReader::time_span_s() const {
  std::pair<double, double> span;
  for (const auto& [sql, value] :
       {std::pair("SELECT simulated_time_s FROM snapshots ORDER BY tick LIMIT 1", &span.first),
        std::pair("SELECT simulated_time_s FROM snapshots ORDER BY tick DESC LIMIT 1", &span.second)}) {
    auto statement = state_->database.prepare(sql);
    if (!statement) return tl::unexpected(statement.error());
    const auto row = statement->step();
    if (!row) return tl::unexpected(row.error());
    if (!*row) return std::optional<std::pair<double, double>>();
    *value = statement->real(0);
  }
  return std::optional(span);
}

Expected<std::pair<double, double>> SessionReader::shown_span_s() const {
  const auto span = time_span_s();
  if (!span) return tl::unexpected(span.error());
  if (*span) return **span;
  const auto log = state_->info.other.find("log");
  if (log != state_->info.other.end() && log->second == "samples")
    return failure("the session was logged without snapshots (--log samples): it can be measured, and not shown again",
                   state_->path.string(), "drive it again with the same options and --log whole");
  return failure("the session holds no snapshots", state_->path.string(), "record a longer drive");
}

Expected<SnapshotCursor> SessionReader::snapshots_from(double simulated_time_s) const {
  const Database& database = state_->database;
  // The keyframe before the time, the first snapshot after it, and the one before that, the cursor's position.
  const auto keyframe = query_tick(database,
                                   "SELECT tick FROM snapshots WHERE baseline_tick IS NULL AND "
                                   "simulated_time_s <= ? ORDER BY simulated_time_s DESC LIMIT 1",
                                   simulated_time_s);
  if (!keyframe) return tl::unexpected(keyframe.error());
  const std::int64_t first = keyframe->value_or(0);
  const auto after =
      query_tick(database, "SELECT tick FROM snapshots WHERE tick >= ? AND simulated_time_s > ? ORDER BY tick LIMIT 1",
                 first, simulated_time_s);
  if (!after) return tl::unexpected(after.error());
  const auto at = query_tick(database, "SELECT max(tick) FROM snapshots WHERE tick < ?",
                             after->value_or(std::numeric_limits<std::int64_t>::max()));
  if (!at) return tl::unexpected(at.error());
  const auto target = static_cast<Tick>(at->value_or(0));
  auto rows = database.prepare(
      "SELECT tick, data, state_hash, simulated_time_s, baseline_tick FROM snapshots WHERE tick >= ? ORDER BY tick");
  if (!rows) return tl::unexpected(rows.error());
  rows->bind(1, first);
  SnapshotCursor cursor(std::make_unique<SnapshotCursor::State>(
      SnapshotCursor::State{std::move(*rows), database.where(), {}, {}, {}, false}));
  for (;;) {
    auto snapshot = cursor.next_wire();
    if (!snapshot) return tl::unexpected(snapshot.error());
    if (*snapshot && (*snapshot)->rest.tick < target) continue;
    cursor.state_->ready = std::move(*snapshot);
    return cursor;
  }
}

Expected<SnapshotCursor> SessionReader::snapshots() const {
  return snapshots_from(-std::numeric_limits<double>::infinity());
}

Expected<std::vector<InputRecord>> SessionReader::inputs(TickRange range) const {
  auto inputs = read_rows(prepare_range(state_->database, "*", "driver_inputs", range, "tick"), read_input);
  const auto has_heads = has_table_called(state_->database, head_positions.name);
  if (!has_heads) return tl::unexpected(has_heads.error());
  if (!inputs || !*has_heads) return inputs;
  const auto heads = read_rows(prepare_range(state_->database, "*", head_positions.name, range, "tick"), read_head);
  if (!heads) return tl::unexpected(heads.error());
  auto input = inputs->begin();
  for (const HeadRecord& record : *heads) {
    input = std::lower_bound(input, inputs->end(), record.tick,
                             [](const InputRecord& of, Tick tick) { return of.tick < tick; });
    if (input != inputs->end() && input->tick == record.tick) input->input.head = record.head;
  }
  return inputs;
}
Expected<std::vector<SceneEdit>> SessionReader::scene_edits(TickRange range) const {
  const auto format = state_->database.query_integer("PRAGMA user_version");
  if (!format) return tl::unexpected(format.error());
  const auto has_fingerprints = has_table_called(state_->database, edit_fingerprints.name);
  if (!has_fingerprints) return tl::unexpected(has_fingerprints.error());
  auto rows = prepare_range(state_->database,
                            *has_fingerprints
                                ? "tick, data, (SELECT nodes FROM edit_fingerprints AS f WHERE f.id = scene_edits.id)"
                                : "tick, data",
                            "scene_edits", range, "id");
  if (!rows) return tl::unexpected(rows.error());
  SceneUnpacker unpacker(static_cast<int>(*format));
  std::vector<SceneEdit> edits;
  for (;;) {
    const auto row = rows->step();
    if (!row) return tl::unexpected(row.error());
    if (!*row) return edits;
    const auto run = read_scene_run(*rows);
    if (!run) return tl::unexpected(run.error());
    if (auto done = unpacker.unpack(*run, edits); !done)
      return failure(done.error().what, fmt::format("{}, {}", state_->path.string(), done.error().where),
                     done.error().remedy);
  }
}
Expected<std::vector<Sample>> SessionReader::samples(TickRange range) const {
  return read_rows(prepare_range(state_->database, "*", "samples", range, "tick"), read_sample);
}
Expected<std::vector<Event>> SessionReader::events(TickRange range) const {
  return read_rows(
      prepare_range(state_->database, "tick, simulated_time_s, kind, participant, detail", "events", range, "id"),
      read_event);
}
Expected<std::vector<QuestionnaireRecord>> SessionReader::questionnaire() const {
  return read_rows(state_->database.prepare("SELECT item, question, answer, value, observed_s, censored, reason "
                                            "FROM questionnaire ORDER BY id"),
                   read_answer);
}

Expected<std::vector<ActuatorRecord>> SessionReader::actuators(TickRange range) const {
  const auto has_actuators = has_table_called(state_->database, "actuators");
  if (!has_actuators) return tl::unexpected(has_actuators.error());
  if (!*has_actuators) return std::vector<ActuatorRecord>();
  return read_rows(prepare_range(state_->database, "*", "actuators", range, "tick"), read_actuators);
}

Expected<std::optional<StateRecord>> SessionReader::saved_state(Tick at_or_before) const {
  const auto has_states = has_table_called(state_->database, saved_states.name);
  if (!has_states) return tl::unexpected(has_states.error());
  if (!*has_states) return std::optional<StateRecord>();
  auto rows =
      read_rows(prepare_range(state_->database, "tick, data", "saved_states", {0, at_or_before}, "tick DESC LIMIT 1"),
                read_state);
  if (!rows) return tl::unexpected(rows.error());
  return rows->empty() ? std::nullopt : std::optional(std::move(rows->front()));
}

Expected<std::vector<Tick>> SessionReader::saved_state_ticks() const {
  const auto has_states = has_table_called(state_->database, saved_states.name);
  if (!has_states) return tl::unexpected(has_states.error());
  if (!*has_states) return std::vector<Tick>();
  const auto read_tick = [](const Statement& row) -> Expected<Tick> { return static_cast<Tick>(row.integer(0)); };
  return read_rows<Tick>(prepare_range(state_->database, "tick", saved_states.name, {}, "tick"), read_tick);
}

Expected<void> SessionReader::check_integrity() const { return logging::check_integrity(state_->database); }
Expected<void> SessionReader::check_values() const { return logging::check_values(state_->database); }

}  // namespace septet::logging
