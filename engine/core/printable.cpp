#include "engine/core/printable.hpp"

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>

namespace septet {
namespace {

/// Length of the UTF-8 sequence at the start of `text`, and its code point; 0 where it is invalid (RFC 3629).
std::size_t read_character(std::string_view text, std::uint32_t& code) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::uint8_t first = byte(0);
  const std::size_t length = first < 0x80             ? 1
                             : (first & 0xE0) == 0xC0 ? 2
                             : (first & 0xF0) == 0xE0 ? 3
                             : (first & 0xF8) == 0xF0 ? 4
                                                      : 0;
  if (length == 0 || length > text.size()) return 0;
  constexpr std::uint8_t payload[] = {0, 0x7F, 0x1F, 0x0F, 0x07};
  code = first & payload[length];
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
    code = code << 6 | (byte(i) & 0x3F);
  }
  constexpr std::uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  return code < least[length] || code > 0x10FFFF || surrogate ? 0 : length;
}

bool is_shown(std::uint32_t code) {
  const bool control = code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0x2028 || code == 0x2029;
  const bool turns =
      code == 0x200E || code == 0x200F || (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
  return !control && !turns;
}

}  // namespace

std::string printable(std::string_view text, std::size_t most_bytes) {
  std::string shown;
  while (!text.empty()) {
    std::uint32_t code = 0;
    const std::size_t length = read_character(text, code);
    std::string next;
    if (length > 0 && is_shown(code))
      next = code == '\\' ? "\\\\" : std::string(text.substr(0, length));
    else
      for (std::size_t i = 0; i < std::max<std::size_t>(length, 1); ++i)
        next += fmt::format("\\x{:02x}", static_cast<std::uint8_t>(text[i]));
    if (shown.size() + next.size() > most_bytes) return shown + "…";
    shown += next;
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return shown;
}

std::optional<std::size_t> printable_characters(std::string_view text) {
  std::size_t count = 0;
  for (; !text.empty(); ++count) {
    std::uint32_t code = 0;
    const std::size_t length = read_character(text, code);
    if (length == 0 || !is_shown(code)) return std::nullopt;
    text.remove_prefix(length);
  }
  return count;
}

}  // namespace septet
