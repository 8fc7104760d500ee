#pragma once
/// One line of a table of comma-separated values.

#include <charconv>
#include <optional>
#include <string_view>
#include <vector>

namespace septet::document {

/// Strips blanks, a line's end and a byte order mark from both ends.
std::string_view trimmed(std::string_view text);

/// Cells between the commas, trimmed; an empty line has one empty cell. Septet's tables have no quotes.
std::vector<std::string_view> cells_of(std::string_view line);

/// The number in a cell, and empty where the cell holds anything else or more.
template <class Number>
std::optional<Number> number_in(std::string_view cell) {
  Number value{};
  const auto [end, status] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (status != std::errc{} || end != cell.data() + cell.size()) return std::nullopt;
  return value;
}

}  // namespace septet::document
