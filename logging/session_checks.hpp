#pragma once
/// What a database must be to be a session of ours, and whole.

#include "engine/core/expected.hpp"
#include "logging/sqlite_database.hpp"

namespace septet::logging {

/// Refuses what is not a session file of a version that is known, and one whose tables somebody has altered.
Expected<void> check_format(const Database& database);

/// Every page of the file.
Expected<void> check_integrity(const Database& database);

/// Every row: each value has its column's type, each text is UTF-8.
Expected<void> check_values(const Database& database);

}  // namespace septet::logging
