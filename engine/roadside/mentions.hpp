#pragma once
/// Case-insensitive search for a word in a name of a road file; files of different makers name their objects
/// differently.

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

namespace septet::roadside {

inline bool mentions(std::string text, std::string_view word) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text.find(word) != std::string::npos;
}

}  // namespace septet::roadside
