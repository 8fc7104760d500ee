#include "engine/document/table_line.hpp"

namespace septet::document {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t\r\n", mark = "\xEF\xBB\xBF";
  if (text.starts_with(mark)) text.remove_prefix(mark.size());
  const auto first = text.find_first_not_of(blank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (;;) {
    const auto comma = line.find(',');
    cells.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

std::optional<TableLine> TableLines::next() {
  while (!text_.empty()) {
    ++number_;
    const auto end = text_.find('\n');
    const std::string_view line = trimmed(text_.substr(0, end));
    text_ = end == std::string_view::npos ? std::string_view{} : text_.substr(end + 1);
    if (!line.empty() && line.front() != '#') return TableLine{number_, cells_of(line)};
  }
  return std::nullopt;
}

}  // namespace septet::document
