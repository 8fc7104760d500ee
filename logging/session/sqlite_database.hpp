#pragma once
/// SQLite 3 as values: a database handle and a statement that close themselves, and errors as
/// `Expected`.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "engine/core/bytes.hpp"
#include "engine/core/expected.hpp"

#include "logging/session/untrusted_database.hpp"

struct sqlite3;
struct sqlite3_stmt;

namespace septet::logging {

enum class OpenMode {
  create,  ///< A new file.
  read,    ///< The file's folder stays untouched.
  change,  ///< For changes to a closed file; remains of a killed program are rolled back or folded in.
};

class Database;

/// A prepared statement. Parameters count from 1, columns from 0, as in SQLite.
class Statement {
 public:
  void bind(int index, std::int64_t value);
  void bind(int index, double value);  ///< NaN is stored as NULL: SQLite has no NaN.
  void bind(int index, std::string_view text);
  void bind(int index,
            std::span<const std::byte> bytes);  ///< The bytes must live until the next `run` or `step`.
  void bind_null(int index);
  void bind(int index, const std::optional<double>& value);
  void bind(int index, const std::optional<std::int64_t>& value);

  /// Executes a statement without rows and prepares it for the next values.
  Expected<void> run();
  /// Steps to the next row; returns false after the last one.
  Expected<bool> step();

  const std::string& where() const { return where_; }
  int columns() const;
  std::string column_name(int column) const;
  /// True for NULL, or for the type that the table declares: INTEGER, REAL, TEXT or BLOB. SQLite alone stores any type
  /// anywhere.
  bool is_of_declared_type(int column) const;
  bool is_text(int column) const;
  bool is_null(int column) const;
  std::int64_t integer(int column) const;
  double real(int column) const;  ///< NaN for NULL.
  std::string text(int column) const;
  /// Valid until the next step.
  std::span<const std::byte> blob(int column) const;

 private:
  friend class Database;
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  Statement(sqlite3_stmt* statement, std::string where, QuestionLimit* limit)
      : statement_(statement), where_(std::move(where)), limit_(limit) {}
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
  std::string where_;
  QuestionLimit* limit_;  ///< Owned by the database.
  std::uint64_t rows_ = 0;
};

class Database {
 public:
  /// The file may belong to another user. For reading, it is opened in place, with the WAL of a running or killed
  /// drive, or through a copy in the temporary folder if a journal must be rolled back. Error: not a database, or a
  /// journal beside it is not Septet's.
  static Expected<Database> open(const std::filesystem::path& path, OpenMode mode);

  Expected<Statement> prepare(std::string_view sql) const;
  Expected<void> execute(const std::string& sql) const;
  /// The first column of the first row.
  Expected<std::int64_t> query_integer(std::string_view sql) const;
  bool in_transaction() const;
  /// True if the last call collided with another connection.
  bool is_busy() const;
  const std::string& where() const { return where_; }

 private:
  struct Close {
    void operator()(sqlite3* database) const;
  };
  Database(sqlite3* database, std::string where)
      : limit_(std::make_unique<QuestionLimit>()), database_(database), where_(std::move(where)) {}
  static Expected<Database> open_with(const std::string& name, int flags, const std::string& where);
  static Expected<Database> open_to_read(const std::filesystem::path& path, const std::string& where);
  static Expected<Database> open_copy(const std::filesystem::path& path, const std::string& where);

  std::unique_ptr<QuestionLimit> limit_;  ///< Outlives the handle, which points to it.
  std::unique_ptr<sqlite3, Close> database_;
  std::string where_;
};

}  // namespace septet::logging
