#pragma once
/// What SQLite may do for a file that somebody else may have made.
///
/// A database brings its own program: triggers, views, generated columns and expressions of indices run when it is used. SQLite's
/// advice for files of others (sqlite.org/security.html) is followed: none of these, no function that a schema asks for, no other
/// file, lower limits, and an end to each question.

#include <cstdint>

struct sqlite3;

namespace septet::logging {

/// How much work one row may cost; kept beside the handle, for SQLite looks at it while it works.
struct QuestionLimit {
  std::int64_t steps_left = 0;
  std::int64_t steps_a_row = 0;  ///< Of SQLite's virtual machine; 0: no limit.
};

/// For every handle: triggers, views, and what a schema asks of functions are off; cells are checked before they are used.
void distrust_schema(sqlite3* database);

/// For a handle that only reads, too: it may select from tables and ask how the file is, and nothing else. `limit` must outlive the
/// handle; `file_bytes` says how much one question may cost.
void allow_reading_alone(sqlite3* database, QuestionLimit& limit, std::int64_t file_bytes);

}  // namespace septet::logging
