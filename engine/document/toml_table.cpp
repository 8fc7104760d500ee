#include "engine/document/toml_table.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/core.h>
#include <toml++/toml.h>

namespace septet::document {
namespace {

constexpr int most_parts = 16;
constexpr std::size_t most_bytes = 1u << 20;  // Ten times the largest file written by hand.

/// Skips a string that begins at `at`; returns the place behind its end.
std::size_t behind_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const std::string threefold(3, quote);
  const bool many_lines = text.substr(at, 3) == threefold;
  at += many_lines ? 3 : 1;
  while (at < text.size()) {
    if (quote == '"' && text[at] == '\\') {
      at += 2;
    } else if (many_lines && text.substr(at, 3) == threefold) {
      return at + 3;
    } else if (!many_lines && (text[at] == quote || text[at] == '\n')) {
      return at + 1;
    } else {
      ++at;
    }
  }
  return text.size();
}

/// Text that toml++ must not see: its beginning (npos: there is none), and its kind.
struct Unreadable {
  std::size_t at = std::string_view::npos;
  std::string what, remedy;
};

bool is_bare_key_character(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-'; }

std::size_t behind_blanks(std::string_view text, std::size_t at) {
  return std::min(text.find_first_not_of(" \t", at), text.size());
}

/// True where the header of a table whose first bracket stands at `at` continues with the text that toml++ assumes (it
/// asserts it): a key, or the bracket that closes an empty one, which it refuses itself.
bool begins_with_key(std::string_view text, std::size_t at) {
  at = behind_blanks(text, at + 1);
  if (at < text.size() && text[at] == '[') at = behind_blanks(text, at + 1);
  return at == text.size() || is_bare_key_character(text[at]) || text[at] == '"' || text[at] == '\'' || text[at] == ']';
}

/// The first key of too many parts, or the first header of a table whose name does not begin as a key does. Numbers
/// count as keys of two parts. Text after the first mistake does not matter: parsing stops there.
Unreadable find_unreadable(std::string_view text) {
  int parts = 1;
  int open_brackets = 0;  // Open arrays and tables within a value: a bracket there begins no header.
  bool line_begins = true;
  std::size_t at = text.starts_with("\xef\xbb\xbf") ? 3 : 0;  // A byte order mark.
  while (at < text.size()) {
    const char c = text[at];
    if (c == '"' || c == '\'') {
      at = behind_string(text, at);
      line_begins = false;
      continue;
    }
    if (c == '#') {
      at = std::min(text.find('\n', at), text.size());
      continue;
    }
    if (c == '[' && line_begins && open_brackets == 0 && !begins_with_key(text, at))
      return {at, "the name of a table does not begin as a key does",
              "write letters, digits, '_' or '-', or put the name into quotes"};
    if (c == '[' || c == '{') ++open_brackets;
    if (c == ']' || c == '}') --open_brackets;
    const bool is_blank = c == ' ' || c == '\t';
    if (c == '.' && ++parts > most_parts)
      return {at, fmt::format("a key has more than {} parts", most_parts), "write a shorter key"};
    if (c != '.' && !is_blank && !is_bare_key_character(c)) parts = 1;
    line_begins = c == '\n' || (line_begins && is_blank);
    ++at;
  }
  return {};
}

std::string text_of(const toml::source_position& place, std::string_view file) {
  return fmt::format("{}:{}:{}", file, place.line, place.column);
}

}  // namespace

std::string place_of(const toml::node& node, std::string_view file) { return text_of(node.source().begin, file); }

Expected<toml::table> parse_toml(std::string_view text, std::string_view file) {
  if (text.size() > most_bytes)
    return failure(fmt::format("is {} bytes long, and no more than {} are read as TOML", text.size(), most_bytes),
                   std::string(file), "give a rig, a vehicle or a film script");
  if (const Unreadable found = find_unreadable(text); found.at != text.npos) {
    const std::string_view before = text.substr(0, found.at);
    const toml::source_position place{static_cast<toml::source_index>(1 + std::ranges::count(before, '\n')),
                                      static_cast<toml::source_index>(found.at - (before.rfind('\n') + 1) + 1)};
    return failure(found.what, text_of(place, file), found.remedy);
  }
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    return failure(fmt::format("is not TOML: {}", error.description()), text_of(error.source().begin, file),
                   "correct the TOML there");
  }
}

Expected<std::vector<std::string>> top_keys_of_toml(std::string_view text, std::string_view file) {
  return parse_toml(text, file).map([](const toml::table& table) {
    std::vector<std::string> keys;
    for (const auto& [key, node] : table) keys.emplace_back(key.str());
    return keys;
  });
}

}  // namespace septet::document
