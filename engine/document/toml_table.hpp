#pragma once
/// TOML text to a table: the one place where Septet parses TOML.
///
/// Files may come from anywhere, session files bring theirs along. toml++ bounds how deeply values are nested, but not of how
/// many parts a dotted key consists, each of which is a table within a table, and takes for granted that the name of a table
/// begins as a key does: such texts are refused before it sees them, and so is one of more than 1 MiB, which it would read for
/// seconds.

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

/// The table of a whole file, for .cpp files that include toml++; an Error names line and column of what is not TOML.
Expected<toml::table> parse_toml(std::string_view text, std::string_view file);

/// Where a value of that file stands: "FILE:LINE:COLUMN".
std::string place_of(const toml::node& node, std::string_view file);

/// The keys at the top of a file, by which one tells what it describes.
Expected<std::vector<std::string>> top_keys_of_toml(std::string_view text, std::string_view file);

}  // namespace septet::document
