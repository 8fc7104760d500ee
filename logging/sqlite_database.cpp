#include "logging/sqlite_database.hpp"

#include <limits>

#include <fmt/core.h>
#include <sqlite3.h>

namespace septet::logging {
namespace {

tl::unexpected<Error> sqlite_failure(sqlite3* database, const std::string& where) {
  const int code = database ? sqlite3_extended_errcode(database) : SQLITE_NOMEM;
  switch (code & 0xff) {
    case SQLITE_FULL:
      return failure("the disk (or the size allowed for the file) is full", where,
                     "free some space or record to another disk; what was written so far is safe");
    case SQLITE_NOTADB:
      return failure("this is not an SQLite file", where, "give a session file that Septet wrote");
    case SQLITE_CORRUPT:
      return failure("the file is damaged", where, "use a copy, or rescue what is left with `sqlite3 FILE .recover`");
    case SQLITE_CANTOPEN:
      return failure("the file cannot be opened", where, "check the path and the permissions of its folder");
    case SQLITE_IOERR:
      return failure(fmt::format("the disk reports an error ({})", sqlite3_errmsg(database)), where,
                     "check free space, quota and the disk itself; what was written so far is safe");
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return failure("another program holds the file", where, "close that program and try again");
    default:
      return failure(fmt::format("SQLite says: {}", database ? sqlite3_errmsg(database) : "out of memory"), where,
                     "check the file with `sqlite3 FILE 'PRAGMA integrity_check'`");
  }
}

/// A path as a file: URI; SQLite reads %, ? and # there.
std::string uri_of(const std::string& path) {
  std::string uri = "file:";
  for (const char c : path) {
    if (c == '%' || c == '?' || c == '#')
      uri += fmt::format("%{:02x}", static_cast<unsigned char>(c));
    else
      uri += c;
  }
  return uri;
}

}  // namespace

void Statement::Finalize::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

void Statement::bind(int index, std::int64_t value) { sqlite3_bind_int64(statement_.get(), index, value); }
void Statement::bind(int index, double value) { sqlite3_bind_double(statement_.get(), index, value); }
void Statement::bind(int index, std::string_view text) {
  sqlite3_bind_text64(statement_.get(), index, text.data() ? text.data() : "", text.size(), SQLITE_TRANSIENT,
                      SQLITE_UTF8);
}
void Statement::bind(int index, std::span<const std::byte> bytes) {
  static constexpr std::byte nothing{};
  sqlite3_bind_blob64(statement_.get(), index, bytes.empty() ? &nothing : bytes.data(), bytes.size(), SQLITE_STATIC);
}
void Statement::bind_null(int index) { sqlite3_bind_null(statement_.get(), index); }
void Statement::bind(int index, const std::optional<double>& value) { value ? bind(index, *value) : bind_null(index); }
void Statement::bind(int index, const std::optional<std::int64_t>& value) {
  value ? bind(index, *value) : bind_null(index);
}

Expected<bool> Statement::step() {
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) return false;
  auto error = sqlite_failure(sqlite3_db_handle(statement_.get()), where_);
  sqlite3_reset(statement_.get());
  return error;
}

Expected<void> Statement::run() {
  const auto stepped = step();
  if (!stepped) return tl::unexpected(stepped.error());
  sqlite3_reset(statement_.get());
  return {};
}

bool Statement::is_null(int column) const { return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL; }
std::int64_t Statement::integer(int column) const { return sqlite3_column_int64(statement_.get(), column); }
double Statement::real(int column) const {
  return is_null(column) ? std::numeric_limits<double>::quiet_NaN() : sqlite3_column_double(statement_.get(), column);
}
std::string Statement::text(int column) const {
  const auto bytes = blob(column);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}
std::span<const std::byte> Statement::blob(int column) const {
  const void* data = sqlite3_column_blob(statement_.get(), column);
  const int size = sqlite3_column_bytes(statement_.get(), column);
  if (!data || size <= 0) return {};
  return {static_cast<const std::byte*>(data), static_cast<std::size_t>(size)};
}

void Database::Close::operator()(sqlite3* database) const { sqlite3_close_v2(database); }

Expected<Database> Database::open(const std::filesystem::path& path, OpenMode mode) {
  const std::string where = path.string();
  std::error_code ignored;
  if (mode == OpenMode::create && std::filesystem::exists(path, ignored))
    return failure("the file exists already, and a log is never overwritten", where,
                   "choose another name or remove it");
  if (mode == OpenMode::read && !std::filesystem::is_regular_file(path, ignored))
    return std::filesystem::exists(path, ignored)
               ? failure("this is no file that can be read as a log", where, "give the log itself")
               : failure("there is no such file", where, "check the path");

  const auto open_with = [&](const std::string& name, int flags) {
    sqlite3* handle = nullptr;
    const int code = sqlite3_open_v2(name.c_str(), &handle, flags | SQLITE_OPEN_NOMUTEX, nullptr);
    Database database(handle, where);
    if (handle) {
      sqlite3_extended_result_codes(handle, 1);
      sqlite3_busy_timeout(handle, 2000);
      sqlite3_db_config(handle, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
      sqlite3_db_config(handle, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    }
    return std::pair(code, std::move(database));
  };
  if (mode == OpenMode::create) {
    auto [code, database] = open_with(where, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
    if (code != SQLITE_OK) return sqlite_failure(database.database_.get(), where);
    return std::move(database);
  }
  // With write permission the WAL of a killed writer is folded in; without it, a closed file still
  // reads as immutable.
  auto [code, database] = open_with(where, SQLITE_OPEN_READWRITE);
  if (code == SQLITE_OK && database.query_integer("SELECT count(*) FROM sqlite_schema")) return std::move(database);
  const auto error = sqlite_failure(database.database_.get(), where);
  if ((sqlite3_errcode(database.database_.get()) & 0xff) == SQLITE_NOTADB) return error;
  auto [read_code, read_only] = open_with(uri_of(where) + "?immutable=1", SQLITE_OPEN_READONLY | SQLITE_OPEN_URI);
  if (read_code == SQLITE_OK && !std::filesystem::exists(where + "-wal", ignored) &&
      read_only.query_integer("SELECT count(*) FROM sqlite_schema"))
    return std::move(read_only);
  return error;
}

Expected<Statement> Database::prepare(std::string_view sql) const {
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(database_.get(), sql.data(), static_cast<int>(sql.size()), &statement, nullptr) != SQLITE_OK)
    return sqlite_failure(database_.get(), where_);
  return Statement(statement, where_);
}

Expected<void> Database::execute(const std::string& sql) const {
  if (sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
    return sqlite_failure(database_.get(), where_);
  return {};
}

Expected<std::int64_t> Database::query_integer(std::string_view sql) const {
  auto statement = prepare(sql);
  if (!statement) return tl::unexpected(statement.error());
  const auto row = statement->step();
  if (!row) return tl::unexpected(row.error());
  return *row ? statement->integer(0) : 0;
}

bool Database::is_busy() const {
  const int code = sqlite3_errcode(database_.get()) & 0xff;
  return code == SQLITE_BUSY || code == SQLITE_LOCKED;
}

bool Database::in_transaction() const { return sqlite3_get_autocommit(database_.get()) == 0; }

}  // namespace septet::logging
