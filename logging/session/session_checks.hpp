#pragma once
/// Checks that a database is a whole session of Septet.

#include "engine/core/expected.hpp"
#include "logging/session/sqlite_database.hpp"

namespace septet::logging {

/// Error: not a session file, an unknown version, or altered tables.
Expected<void> check_format(const Database& database);

/// Checks every page of the file.
Expected<void> check_integrity(const Database& database);

/// Checks every row: each value has its column's type, each text is UTF-8.
Expected<void> check_values(const Database& database);

}  // namespace septet::logging
