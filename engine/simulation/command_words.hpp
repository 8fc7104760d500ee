#pragma once
/// Words of a logged command's text: "name=value name=value".

#include <algorithm>
#include <charconv>
#include <string_view>
#include <system_error>

namespace septet::simulation {

/// Takes the first word, and the space behind it, from the text.
inline std::string_view take_word(std::string_view& text) {
  const std::string_view word = text.substr(0, text.find(' '));
  text.remove_prefix(std::min(word.size() + 1, text.size()));
  return word;
}

/// The number in a text that holds nothing else; false: there is none.
template <class Number>
bool read_number(std::string_view text, Number& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace septet::simulation
