#include "engine/net/address.hpp"

#include <charconv>

#include <fmt/format.h>

namespace septet::net {
namespace {

/// Reads one decimal number of at most `limit` from the front of `text`; false leaves `value` undefined.
bool take_number(std::string_view& text, std::uint32_t limit, std::uint32_t& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || value > limit) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

bool take_ip(std::string_view& text, std::uint32_t& ip) {
  ip = 0;
  for (int i = 0; i < 4; ++i) {
    std::uint32_t byte = 0;
    if (i > 0) {
      if (!text.starts_with('.')) return false;
      text.remove_prefix(1);
    }
    if (!take_number(text, 255, byte)) return false;
    ip = ip << 8 | byte;
  }
  return true;
}

}  // namespace

std::string ip_text(std::uint32_t ip) {
  return fmt::format("{}.{}.{}.{}", ip >> 24, ip >> 16 & 0xff, ip >> 8 & 0xff, ip & 0xff);
}

std::string to_text(const Address& address) { return fmt::format("{}:{}", ip_text(address.ip), address.port); }

Expected<std::uint32_t> parse_ip(std::string_view text, std::string_view where) {
  std::string_view rest = text;
  std::uint32_t ip = 0;
  if (!take_ip(rest, ip) || !rest.empty())
    return failure(fmt::format("\"{}\" is not an IPv4 address", text), std::string(where),
                   "write four numbers from 0 to 255, such as 192.168.1.10");
  return ip;
}

Expected<Address> parse_address(std::string_view text, std::string_view where) {
  std::string_view rest = text;
  Address address;
  std::uint32_t port = 0;
  const bool good = take_ip(rest, address.ip) && rest.starts_with(':') &&
                    (rest.remove_prefix(1), take_number(rest, 65535, port)) && rest.empty();
  if (!good)
    return failure(fmt::format("\"{}\" is not an IPv4 address and port", text), std::string(where),
                   "write it as 192.168.1.10:4750, with a port from 0 to 65535");
  address.port = static_cast<std::uint16_t>(port);
  return address;
}

}  // namespace septet::net
