#include "logging/session/sqlite_database.hpp"

#include <limits>

#include <fmt/core.h>
#include <sqlite3.h>

#include "logging/session/files_beside.hpp"

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
    case SQLITE_INTERRUPT:
      return failure("the file is damaged or made to keep its reader busy: one question takes too long", where,
                     "use a copy, and do not trust who sent it");
    case SQLITE_READONLY:
      return failure("the file cannot be written", where, "check the permissions of the file and its folder");
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return failure("another program holds the file", where, "close that program and try again");
    default:
      return failure(fmt::format("SQLite says: {}", database ? sqlite3_errmsg(database) : "out of memory"), where,
                     "check the file with `sqlite3 FILE 'PRAGMA integrity_check'`");
  }
}

/// Reads the schema, and with it the files beside the file.
constexpr std::string_view first_question = "SELECT 1 FROM sqlite_schema LIMIT 1";

/// Upper bound of rows in a file, each of at least 4 bytes: a damaged file may lead in circles.
std::uint64_t most_rows(const std::string& where) {
  std::uint64_t bytes = 0;
  std::error_code error;
  for (const char* ending : {"", "-wal"})
    if (const auto size = std::filesystem::file_size(where + ending, error); !error) bytes += size;
  return bytes / 4 + 1;
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
  limit_->steps_left = limit_->steps_a_row;
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW) {
    // Asked of the file system only now and then: it grows while a drive is recorded.
    constexpr std::uint64_t rows_between_looks = 1 << 16;
    if (++rows_ % rows_between_looks != 0 || rows_ <= most_rows(where_)) return true;
    return failure("the file is damaged: its rows have no end", where_, "use a copy");
  }
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

int Statement::columns() const { return sqlite3_column_count(statement_.get()); }
std::string Statement::column_name(int column) const {
  const char* name = sqlite3_column_name(statement_.get(), column);
  return name ? name : "";
}
bool Statement::is_of_declared_type(int column) const {
  const char* declared = sqlite3_column_decltype(statement_.get(), column);
  const std::string_view type = declared ? declared : "";
  switch (sqlite3_column_type(statement_.get(), column)) {
    case SQLITE_INTEGER:
      return type == "INTEGER";
    case SQLITE_FLOAT:
      return type == "REAL";
    case SQLITE_TEXT:
      return type == "TEXT";
    case SQLITE_BLOB:
      return type == "BLOB";
    default:
      return true;
  }
}
bool Statement::is_text(int column) const { return sqlite3_column_type(statement_.get(), column) == SQLITE_TEXT; }
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

Expected<Database> Database::open_with(const std::string& name, int flags, const std::string& where) {
  sqlite3* handle = nullptr;
  const int code = sqlite3_open_v2(name.c_str(), &handle, flags | SQLITE_OPEN_NOMUTEX, nullptr);
  Database database(handle, where);
  if (code != SQLITE_OK) return sqlite_failure(handle, where);
  sqlite3_extended_result_codes(handle, 1);
  sqlite3_busy_timeout(handle, 2000);
  distrust_schema(handle);
  return database;
}

Expected<Database> Database::open(const std::filesystem::path& path, OpenMode mode) {
  const std::string where = path.string();
  std::error_code ignored;
  if (mode == OpenMode::create) {
    if (std::filesystem::exists(path, ignored))
      return failure("the file exists already, and a log is never overwritten", where,
                     "choose another name or remove it");
    return open_with(where, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, where);
  }
  if (std::filesystem::is_directory(path, ignored))
    return failure("this is a folder", where, "give the session file in it, such as session.sqlite");
  if (!std::filesystem::is_regular_file(path, ignored))
    return std::filesystem::exists(path, ignored)
               ? failure("this is no file that can be read as a log", where, "give the log itself")
               : failure("there is no such file", where, "check the path");
  // SQLite deletes the files beside an empty file.
  if (std::filesystem::file_size(path, ignored) == 0)
    return failure("this file is empty, not an SQLite file", where, "give a session file that Septet wrote");
  // SQLite looks for side files beside the target of a link; so does Septet.
  const std::filesystem::path real = std::filesystem::canonical(path, ignored);
  if (ignored) return failure(ignored.message(), where, "check the path");
  if (mode == OpenMode::read) return open_to_read(real, where);
  if (auto checked = check_journal(real); !checked) return tl::unexpected(checked.error());
  auto database = open_with(real.string(), SQLITE_OPEN_READWRITE, where);
  if (!database) return database;
  if (auto opened = database->query_integer(first_question); !opened) return tl::unexpected(opened.error());
  return database;
}

Expected<Database> Database::open_to_read(const std::filesystem::path& path, const std::string& where) {
  const auto way = way_to_read(path);
  if (!way) return tl::unexpected(way.error());
  if (*way == ReadWay::copied) return open_copy(path, where);
  const auto open_as = [&](const char* option) -> Expected<Database> {
    auto database = open_with(uri_of(path.string()) + option, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, where);
    if (!database) return database;
    std::error_code ignored;
    const auto bytes = std::filesystem::file_size(path, ignored);
    allow_reading_alone(database->database_.get(), *database->limit_, ignored ? 0 : static_cast<std::int64_t>(bytes));
    if (auto opened = database->query_integer(first_question); !opened) return tl::unexpected(opened.error());
    return database;
  };
  if (*way == ReadWay::immutable) return open_as("?immutable=1");
  // A WAL without a writer can be read without write access to its index; one with an empty index is copied.
  if (*way == ReadWay::with_wal)
    return open_as("?readonly_shm=1").or_else([&](const Error&) { return open_copy(path, where); });
  return open_as("");
}

Expected<Database> Database::open_copy(const std::filesystem::path& path, const std::string& where) {
  const auto folder = PrivateFolder::create();
  if (!folder) return tl::unexpected(folder.error());
  const auto copy = copy_with_files_beside(path, *folder);
  if (!copy) return tl::unexpected(copy.error());
  {
    const auto whole = open_with(copy->string(), SQLITE_OPEN_READWRITE, where);
    if (!whole) return tl::unexpected(whole.error());
    if (auto folded = whole->execute("PRAGMA journal_mode=DELETE"); !folded) return tl::unexpected(folded.error());
    if (auto opened = whole->query_integer(first_question); !opened) return tl::unexpected(opened.error());
  }
  // The handle keeps the file: the folder can go at once, and a killed program leaves no remains.
  return open_to_read(*copy, where);
}

Expected<Statement> Database::prepare(std::string_view sql) const {
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(database_.get(), sql.data(), static_cast<int>(sql.size()), &statement, nullptr) != SQLITE_OK)
    return sqlite_failure(database_.get(), where_);
  return Statement(statement, where_, limit_.get());
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
