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

#include "logging/untrusted_database.hpp"

struct sqlite3;
struct sqlite3_stmt;

namespace septet::logging {

enum class OpenMode {
  create,  ///< A new file.
  read,    ///< Nothing in the file's folder is written, made or removed.
  change,  ///< To change a closed file; what a killed program left is rolled back or folded in.
};

class Database;

/// A prepared statement. Parameters count from 1, columns from 0, as in SQLite.
class Statement {
 public:
  void bind(int index, std::int64_t value);
  void bind(int index, double value);  ///< NaN is stored as NULL: SQLite has none.
  void bind(int index, std::string_view text);
  void bind(int index,
            std::span<const std::byte> bytes);  ///< The bytes must live until the next `run` or `step`.
  void bind_null(int index);
  void bind(int index, const std::optional<double>& value);
  void bind(int index, const std::optional<std::int64_t>& value);

  /// Executes a statement without rows and makes it ready for the next values.
  Expected<void> run();
  /// Goes to the next row; false after the last one.
  Expected<bool> step();

  const std::string& where() const { return where_; }
  int columns() const;
  std::string column_name(int column) const;
  /// INTEGER, REAL, TEXT or BLOB as the table says, or NULL. SQLite alone stores anything anywhere.
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
  QuestionLimit* limit_;  ///< The database's.
  std::uint64_t rows_ = 0;
};

class Database {
 public:
  /// The file may be somebody else's. To be read, it is opened where it lies, with the WAL of a drive that goes on or was killed,
  /// or through a copy in the temporary folder where a journal must be rolled back.
  /// Error: it is no database, or a journal beside it is not Septet's.
  static Expected<Database> open(const std::filesystem::path& path, OpenMode mode);

  Expected<Statement> prepare(std::string_view sql) const;
  Expected<void> execute(const std::string& sql) const;
  /// The first column of the first row.
  Expected<std::int64_t> query_integer(std::string_view sql) const;
  bool in_transaction() const;
  /// Whether what was done last met another connection in its way.
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

  std::unique_ptr<QuestionLimit> limit_;  ///< Outlives the handle, which looks at it.
  std::unique_ptr<sqlite3, Close> database_;
  std::string where_;
};

}  // namespace septet::logging
