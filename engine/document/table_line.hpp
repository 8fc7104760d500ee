#pragma once
/// One line of a table of comma-separated values.

#include <charconv>
#include <optional>
#include <string_view>
#include <vector>

namespace septet::document {

/// Without blanks, the end of a line and a byte order mark around it.
std::string_view trimmed(std::string_view text);

/// What lies between the commas, trimmed; of an empty line one empty cell. Nothing is quoted in Septet's tables.
std::vector<std::string_view> cells_of(std::string_view line);

/// The number that a cell is, and nothing where it is anything else or more.
template <class Number>
std::optional<Number> number_in(std::string_view cell) {
  Number value{};
  const auto [end, status] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (status != std::errc{} || end != cell.data() + cell.size()) return std::nullopt;
  return value;
}

}  // namespace septet::document
