#pragma once
/// Text from outside, made fit for a terminal and a log: a client chooses it, and a terminal obeys what it contains.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace septet {

/// `text` with what is not to be printed as \xNN: control characters (newline, escape and the C1 codes), marks that turn the direction of
/// writing, and bytes that are no UTF-8. A backslash is doubled. Longer than `most_bytes` it is cut, and ends in "…".
std::string printable(std::string_view text, std::size_t most_bytes = 400);

/// How many characters `text` has; nothing where one of them is not to be printed.
std::optional<std::size_t> printable_characters(std::string_view text);

}  // namespace septet
