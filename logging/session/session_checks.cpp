#include "logging/session/session_checks.hpp"

#include <cstdint>
#include <span>

#include <fmt/core.h>

#include "logging/session/schema.hpp"

namespace septet::logging {
namespace {

/// RFC 3629: no overlong form, no surrogate, nothing above U+10FFFF.
bool is_utf8(std::span<const std::byte> bytes) {
  constexpr std::uint32_t least[] = {0, 0x80, 0x800, 0x10000};
  for (std::size_t i = 0; i < bytes.size();) {
    const auto first = static_cast<std::uint32_t>(bytes[i++]);
    if (first < 0x80) continue;
    const std::size_t more = first >= 0xf0 ? 3 : first >= 0xe0 ? 2 : 1;
    if (first < 0xc2 || first > 0xf4 || bytes.size() - i < more) return false;
    std::uint32_t code = first & (0x3fu >> more);
    for (std::size_t k = 0; k < more; ++k) {
      const auto next = static_cast<std::uint32_t>(bytes[i++]);
      if ((next & 0xc0u) != 0x80u) return false;
      code = code << 6 | (next & 0x3fu);
    }
    if (code < least[more] || code > 0x10ffff || (code >= 0xd800 && code < 0xe000)) return false;
  }
  return true;
}

Expected<void> check_values_of(const Database& database, const Table& table) {
  auto rows = database.prepare(fmt::format("SELECT * FROM {}", table.name));
  if (!rows) return tl::unexpected(rows.error());
  for (std::uint64_t number = 1;; ++number) {
    const auto row = rows->step();
    if (!row) return tl::unexpected(row.error());
    if (!*row) return {};
    for (int column = 0; column < rows->columns(); ++column) {
      const bool is_of_type = rows->is_of_declared_type(column);
      if (is_of_type && (!rows->is_text(column) || is_utf8(rows->blob(column)))) continue;
      return failure(
          fmt::format("row {} of the table {} has {} in its column {}", number, table.name,
                      is_of_type ? "a text that is no UTF-8" : "a value of another type", rows->column_name(column)),
          database.where(), "it was altered or damaged: use an unaltered copy");
    }
  }
}

}  // namespace

/// Error: not a session file of this version.
Expected<void> check_format(const Database& database) {
  const auto id = database.query_integer("PRAGMA application_id");
  if (!id) return tl::unexpected(id.error());
  if (*id != application_id)
    return failure("this is an SQLite file, but not one of Septet's sessions", database.where(),
                   "give a session file that Septet wrote");
  const auto version = database.query_integer("PRAGMA user_version");
  if (!version) return tl::unexpected(version.error());
  if (*version < oldest_format_version || *version > format_version)
    return failure(fmt::format("the session has format {}, and this Septet reads formats {} to {}", *version,
                               oldest_format_version, format_version),
                   database.where(), "use the version of Septet that wrote it (meta row septet_version)");
  const auto check_table = [&](const Table& table, bool may_be_missing) -> Expected<void> {
    auto statement = database.prepare("SELECT sql FROM sqlite_schema WHERE name = ? COLLATE NOCASE");
    if (!statement) return tl::unexpected(statement.error());
    statement->bind(1, table.name);
    const auto row = statement->step();
    if (!row) return tl::unexpected(row.error());
    if (!*row ? may_be_missing : statement->text(0) == table.sql) return {};
    return failure(fmt::format("the table {} is missing or not that of format {}", table.name, *version),
                   database.where(), "use an unaltered session file");
  };
  for (const Table& table : tables)
    if (auto checked = check_table(table, false); !checked) return checked;
  for (const Table& table : later_tables)
    if (auto checked = check_table(table, true); !checked) return checked;
  const auto triggers = database.query_integer("SELECT count(*) FROM sqlite_schema WHERE type = 'trigger'");
  if (!triggers) return tl::unexpected(triggers.error());
  if (*triggers > 0)
    return failure("the session holds a trigger, which would change it by itself: none of Septet's does",
                   database.where(), "somebody has altered it: use an unaltered session file");
  return {};
}

Expected<void> check_integrity(const Database& database) {
  auto check = database.prepare("PRAGMA integrity_check(1)");
  if (!check) return tl::unexpected(check.error());
  const auto row = check->step();
  if (!row) return tl::unexpected(row.error());
  const std::string answer = *row ? check->text(0) : "no answer";
  if (answer != "ok")
    return failure(fmt::format("the file is damaged: {}", answer), database.where(),
                   "use a copy, or rescue what is left with `sqlite3 FILE .recover`");
  return {};
}

Expected<void> check_values(const Database& database) {
  for (const Table& table : tables)
    if (auto checked = check_values_of(database, table); !checked) return checked;
  for (const Table& table : later_tables) {
    const auto count = database.query_integer(
        fmt::format("SELECT count(*) FROM sqlite_schema WHERE type = 'table' AND name = '{}'", table.name));
    if (!count) return tl::unexpected(count.error());
    if (*count == 0) continue;
    if (auto checked = check_values_of(database, table); !checked) return checked;
  }
  return {};
}

}  // namespace septet::logging
