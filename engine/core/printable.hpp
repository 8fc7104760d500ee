#pragma once
/// Text from outside, made safe for a terminal and a log: a client chooses it, and a terminal obeys control codes in
/// it.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace septet {

/// `text` with unprintable parts as \xNN: control characters (newline, escape and the C1 codes), marks of writing
/// direction, and bytes that are not UTF-8. A backslash is doubled. Text longer than `most_bytes` is cut, and ends in
/// "…".
std::string printable(std::string_view text, std::size_t most_bytes = 400);

/// Number of characters in `text`; empty where one of them is unprintable.
std::optional<std::size_t> printable_characters(std::string_view text);

}  // namespace septet
