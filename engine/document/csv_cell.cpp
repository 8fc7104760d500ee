#include "engine/document/csv_cell.hpp"

#include <string_view>

namespace septet::document {

std::string csv_cell(const std::string& text) {
  std::string value =
      !text.empty() && std::string_view("=+-@'").find(text[0]) != std::string_view::npos ? '\'' + text : text;
  if (value.find_first_of(",\"\r\n") == std::string::npos) return value;
  std::string quoted = "\"";
  for (const char c : value) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

}  // namespace septet::document
