#pragma once
/// Lines of a table of comma-separated values.

#include <charconv>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace septet::document {

/// Strips blanks, a line's end and a byte order mark from both ends.
std::string_view trimmed(std::string_view text);

/// Cells between the commas, trimmed; an empty line has one empty cell. Septet's tables have no quotes.
std::vector<std::string_view> cells_of(std::string_view line);

struct TableLine {
  std::size_t number = 0;  ///< In the text, from 1.
  std::vector<std::string_view> cells;
};

/// The lines of a text that hold cells, in order: empty ones and remarks (`#`) are passed over. The text outlives it.
class TableLines {
 public:
  explicit TableLines(std::string_view text) : text_(text) {}
  /// Empty at the text's end.
  std::optional<TableLine> next();

 private:
  std::string_view text_;
  std::size_t number_ = 0;
};

/// The number in a cell, and empty where the cell holds anything else or more.
template <class Number>
std::optional<Number> number_in(std::string_view cell) {
  Number value{};
  const auto [end, status] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (status != std::errc{} || end != cell.data() + cell.size()) return std::nullopt;
  return value;
}

}  // namespace septet::document
