#pragma once
/// Rows of FORMAT.md's tables: one prepared INSERT per table, and one function per table that reads
/// a row back. Column order is that of schema.hpp.

#include "engine/core/expected.hpp"
#include "logging/session/records.hpp"
#include "logging/session/scene_runs.hpp"
#include "logging/session/sqlite_database.hpp"

namespace septet::logging {

/// For a tick at which the head was not at rest.
struct HeadRecord {
  Tick tick = 0;
  Head head;
};

struct InsertStatements {
  Statement snapshot, input, scene_run, sample, event, answer, state, actuators, head, fingerprints;
};
Expected<InsertStatements> prepare_inserts(const Database& database);
Expected<Statement> prepare_answer_insert(const Database& database);  ///< Works for a session that lacks later tables.

Expected<void> insert_info(const Database& database, const SessionInfo& info);
Expected<void> insert_meta(const Database& database, const std::string& key, const std::string& value);
Expected<void> insert(Statement& statement, const InputRecord& record);
Expected<void> insert_head(Statement& statement, const InputRecord& record);  ///< Writes no row for a head at rest.
Expected<void> insert(Statement& statement, const SceneRun& run);
/// Of the row that was inserted last; writes no row for a run without fingerprints.
Expected<void> insert_fingerprints(Statement& statement, const SceneRun& run);
Expected<void> insert(Statement& statement, const Sample& sample);
Expected<void> insert(Statement& statement, const Event& event);
Expected<void> insert(Statement& statement, const QuestionnaireRecord& answer);
Expected<void> insert(Statement& statement, const StateRecord& state);
Expected<void> insert(Statement& statement, const ActuatorRecord& actuators);

Expected<SessionInfo> read_info(const Database& database);
Expected<InputRecord> read_input(const Statement& row);  ///< Without the head.
Expected<HeadRecord> read_head(const Statement& row);
Expected<SceneRun> read_scene_run(
    const Statement& row);  ///< Columns tick, data and, where the session has them, fingerprints.
Expected<StateRecord> read_state(const Statement& row);
Expected<ActuatorRecord> read_actuators(const Statement& row);
Expected<Sample> read_sample(const Statement& row);
Expected<Event> read_event(const Statement& row);                 ///< Without the id.
Expected<QuestionnaireRecord> read_answer(const Statement& row);  ///< Without the id.

}  // namespace septet::logging
