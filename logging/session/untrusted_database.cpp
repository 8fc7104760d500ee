#include "logging/session/untrusted_database.hpp"

#include <algorithm>
#include <initializer_list>
#include <string_view>
#include <utility>

#include <sqlite3.h>

namespace septet::logging {
namespace {

/// The largest text or blob of a row: a road network as a file is the largest that a session has.
constexpr int largest_value_bytes = 512 << 20;
constexpr int steps_between_looks = 100'000;
/// Limit for one row: the cost of `integrity_check` for the largest table, with room to spare.
constexpr std::int64_t least_steps_a_row = 50'000'000, steps_a_byte = 4;

bool is_one_of(const char* word, std::initializer_list<std::string_view> words) {
  return word && std::ranges::find(words, std::string_view(word)) != words.end();
}

int may(void*, int action, const char* first, const char* second, const char*, const char*) {
  switch (action) {
    case SQLITE_SELECT:
    case SQLITE_READ:
      return SQLITE_OK;
    case SQLITE_FUNCTION:
      return is_one_of(second, {"count", "max", "ifnull"}) ? SQLITE_OK : SQLITE_DENY;
    case SQLITE_PRAGMA:
      if (is_one_of(first, {"integrity_check"})) return SQLITE_OK;
      return !second && is_one_of(first, {"application_id", "user_version"}) ? SQLITE_OK : SQLITE_DENY;
    default:
      return SQLITE_DENY;
  }
}

int count_steps(void* limit) {
  auto& left = static_cast<QuestionLimit*>(limit)->steps_left;
  left -= steps_between_looks;
  return left < 0 ? 1 : 0;
}

}  // namespace

void distrust_schema(sqlite3* database) {
  sqlite3_db_config(database, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(database, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(database, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
  sqlite3_db_config(database, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
  sqlite3_db_config(database, SQLITE_DBCONFIG_ENABLE_LOAD_EXTENSION, 0, nullptr);
  sqlite3_exec(database, "PRAGMA cell_size_check=ON", nullptr, nullptr, nullptr);
  // Sorting, which the file's statistics or a missing index may cause, must not use a temporary file: SQLite attaches
  // it.
  sqlite3_exec(database, "PRAGMA temp_store=MEMORY", nullptr, nullptr, nullptr);
  constexpr std::pair<int, int> limits[] = {{SQLITE_LIMIT_LENGTH, largest_value_bytes},
                                            {SQLITE_LIMIT_SQL_LENGTH, 100'000},
                                            {SQLITE_LIMIT_COLUMN, 200},
                                            {SQLITE_LIMIT_EXPR_DEPTH, 100},
                                            {SQLITE_LIMIT_COMPOUND_SELECT, 10},
                                            {SQLITE_LIMIT_FUNCTION_ARG, 8},
                                            {SQLITE_LIMIT_LIKE_PATTERN_LENGTH, 100},
                                            {SQLITE_LIMIT_TRIGGER_DEPTH, 1}};
  for (const auto& [what, most] : limits) sqlite3_limit(database, what, most);
}

void allow_reading_alone(sqlite3* database, QuestionLimit& limit, std::int64_t file_bytes) {
  sqlite3_exec(database, "PRAGMA query_only=ON", nullptr, nullptr, nullptr);
  sqlite3_limit(database, SQLITE_LIMIT_ATTACHED, 0);
  sqlite3_set_authorizer(database, may, nullptr);
  limit.steps_a_row = std::max(least_steps_a_row, steps_a_byte * std::max<std::int64_t>(file_bytes, 0));
  limit.steps_left = limit.steps_a_row;
  sqlite3_progress_handler(database, steps_between_looks, count_steps, &limit);
}

}  // namespace septet::logging
