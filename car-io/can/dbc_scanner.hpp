#pragma once
/// Tokens of a DBC file, in sequence, with their lines. For dbc.cpp and dbc_signal.cpp.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace septet::car_io::dbc {

class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  int line() const { return line_; }
  bool at_end();
  /// Next non-space character, without taking it; 0 at the end.
  char peek();
  bool take(char wanted);
  /// A C identifier; empty (and nothing taken) otherwise.
  std::optional<std::string_view> take_identifier();
  std::optional<std::string_view> peek_identifier();
  /// An identifier that may begin with a digit, as in real files' messages and signals; or empty.
  std::optional<std::string_view> take_name();
  /// Likewise, where it stands in that line.
  std::optional<std::string_view> take_name_in(int line);
  /// A finite number, or empty.
  std::optional<double> take_number();
  std::optional<std::uint64_t> take_unsigned();
  /// A quoted text, which may span several lines; empty if it begins otherwise or never ends.
  std::optional<std::string> take_string();
  /// Skips one word of any kind; false at the end, or at a quoted text without an end.
  bool skip_word();
  /// From the next non-space character to the end of its line, without taking it.
  std::string_view rest_of_line();
  /// Skips to the end of the line.
  void skip_line();

 private:
  std::optional<std::string_view> peek_name();
  void skip_space();
  void advance(std::size_t count);

  std::string_view text_;
  std::size_t place_ = 0;
  int line_ = 1;
};

}  // namespace septet::car_io::dbc
