#include "engine/document/toml_table.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/core.h>
#include <toml++/toml.h>

namespace septet::document {
namespace {

constexpr int most_parts = 16;
constexpr std::size_t most_bytes = 1u << 20;  // Ten times the largest file that anybody writes by hand.

/// Steps over a string that begins at `at`; the place behind its end.
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

/// The place of the first key of more parts than anybody needs; npos: there is none. Numbers count as keys of two parts.
std::size_t find_long_key(std::string_view text) {
  int parts = 1;
  std::size_t at = 0;
  while (at < text.size()) {
    const char c = text[at];
    if (c == '"' || c == '\'') {
      at = behind_string(text, at);
      continue;
    }
    if (c == '#') {
      at = std::min(text.find('\n', at), text.size());
      continue;
    }
    const bool of_key = std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || c == ' ' || c == '\t';
    if (c == '.' && ++parts > most_parts) return at;
    if (c != '.' && !of_key) parts = 1;
    ++at;
  }
  return text.npos;
}

std::string text_of(const toml::source_position& place, std::string_view file) { return fmt::format("{}:{}:{}", file, place.line, place.column); }

}  // namespace

std::string place_of(const toml::node& node, std::string_view file) { return text_of(node.source().begin, file); }

Expected<toml::table> parse_toml(std::string_view text, std::string_view file) {
  if (text.size() > most_bytes)
    return failure(fmt::format("is {} bytes long, and no more than {} are read as TOML", text.size(), most_bytes), std::string(file), "give a rig, a vehicle or a film script");
  if (const auto at = find_long_key(text); at != text.npos) {
    const std::string_view before = text.substr(0, at);
    const toml::source_position place{static_cast<toml::source_index>(1 + std::ranges::count(before, '\n')),
                                      static_cast<toml::source_index>(at - (before.rfind('\n') + 1) + 1)};
    return failure(fmt::format("a key has more than {} parts", most_parts), text_of(place, file), "write a shorter key");
  }
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    return failure(fmt::format("is not TOML: {}", error.description()), text_of(error.source().begin, file), "correct the TOML there");
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
