#pragma once
/// Restrictions on SQLite for files of unknown origin.
///
/// A database brings its own program: triggers, views, generated columns and expressions of indices run when it is
/// used. SQLite's advice for files of others (sqlite.org/security.html) is followed: all of these are off, and
/// functions that a schema asks for, and other files; limits are lower, and each query ends.

#include <cstdint>

struct sqlite3;

namespace septet::logging {

/// Work that one row may cost; kept beside the handle, since SQLite checks it while it works.
struct QuestionLimit {
  std::int64_t steps_left = 0;
  std::int64_t steps_a_row = 0;  ///< Steps of SQLite's virtual machine; 0: no limit.
};

/// For every handle: triggers, views, and functions requested by a schema are off; cells are checked before use.
void distrust_schema(sqlite3* database);

/// For a handle that only reads, too: it may select from tables and query the file's state, and nothing else. `limit`
/// must outlive the handle; `file_bytes` sets the cost of one query.
void allow_reading_alone(sqlite3* database, QuestionLimit& limit, std::int64_t file_bytes);

}  // namespace septet::logging
