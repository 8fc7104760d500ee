#pragma once
/// Reads one TOML table key by key, with ranges, and remembers the first error. For .cpp files that read a TOML file:
/// toml++ types, which it only names, stay there.

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/math/rigid_transform.hpp"

namespace toml {
inline namespace v3 {
class node;
class table;
class array;
}  // namespace v3
}  // namespace toml

namespace septet::document {

class TableReader {
 public:
  /// `error` is shared by the readers of one file and keeps the first report.
  TableReader(const toml::table& table, std::string_view file, std::string title, Error& error);

  std::string get_string(std::string_view key, std::string fallback);
  bool get_bool(std::string_view key, bool fallback);
  double get_double(std::string_view key, double fallback, double low, double high);
  std::int64_t get_integer(std::string_view key, std::int64_t fallback, std::int64_t low, std::int64_t high);
  /// The index of the text in `choices`, or `fallback` where the key is absent.
  std::size_t get_choice(std::string_view key, std::size_t fallback, const std::vector<std::string_view>& choices);
  Vec3 get_point(std::string_view key);
  std::vector<const toml::table*> get_tables(std::string_view key);
  const toml::table* get_table(std::string_view key);
  /// Null where the key is absent, or is not a list, which is reported.
  const toml::array* get_array(std::string_view key);
  /// Reports a key that was never read; `documented_in` is the file that lists the known ones.
  void finish(std::string_view documented_in);
  /// Reports with line and column of `key`, or of the table where the key is absent.
  void report(std::string_view key, std::string what, std::string remedy);

 private:
  const toml::node* find(std::string_view key);

  const toml::table& table_;
  std::string file_;
  std::string title_;
  Error& error_;
  std::set<std::string, std::less<>> known_;
};

}  // namespace septet::document
