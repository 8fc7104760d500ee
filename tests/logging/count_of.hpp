#pragma once
// Number of occurrences of a text in a page.

#include <string>

namespace septet::logging {

inline int count_of(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

}  // namespace septet::logging
