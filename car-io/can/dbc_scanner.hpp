#pragma once
/// The words of a DBC file, one after the other, with the line that each stands in. For dbc.cpp.

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
  /// The next character that is no space, without taking it; 0 at the end.
  char peek();
  bool take(char wanted);
  /// A C identifier, or nothing (and nothing is taken).
  std::optional<std::string_view> take_identifier();
  std::optional<std::string_view> peek_identifier();
  /// An identifier that may begin with a digit, as people's names of messages and signals do; or nothing.
  std::optional<std::string_view> take_name();
  /// A finite number, or nothing.
  std::optional<double> take_number();
  std::optional<std::uint64_t> take_unsigned();
  /// A text in quotes, which may go over several lines; nothing where it begins otherwise or never ends.
  std::optional<std::string> take_string();
  /// One word of any kind; false at the end, or where a text in quotes has none.
  bool skip_word();
  /// Up to the end of the line.
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
