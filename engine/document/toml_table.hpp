#pragma once
/// TOML text to a table: the one place where Septet parses TOML.
///
/// Files may come from anywhere; session files carry theirs along. toml++ bounds the nesting of values, but not the
/// number of parts of a dotted key, each of which is a table within a table, and assumes that the name of a table
/// begins as a key does: texts that break either are refused before it sees them, and so is one of more than 1 MiB,
/// which it would read for seconds.

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/expected.hpp"

namespace toml {
inline namespace v3 {
class node;
class table;
}  // namespace v3
}  // namespace toml

namespace septet::document {

/// Parses a whole file, for .cpp files that include toml++. Error: line and column of invalid TOML.
Expected<toml::table> parse_toml(std::string_view text, std::string_view file);

/// Place of a value in that file: "FILE:LINE:COLUMN".
std::string place_of(const toml::node& node, std::string_view file);

/// Top-level keys of a file, which tell its kind.
Expected<std::vector<std::string>> top_keys_of_toml(std::string_view text, std::string_view file);

}  // namespace septet::document
