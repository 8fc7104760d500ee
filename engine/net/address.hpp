#pragma once
/// Address of a datagram's sender or receiver: an IPv4 address and a UDP port.

#include <compare>
#include <cstdint>
#include <string>
#include <string_view>

#include "engine/core/expected.hpp"

namespace septet::net {

struct Address {
  std::uint32_t ip = 0;    ///< Host byte order: 127.0.0.1 is 0x7f000001; 0 means any interface.
  std::uint16_t port = 0;  ///< 0 lets the system choose one when a socket is opened.

  auto operator<=>(const Address&) const = default;
};

inline constexpr std::uint32_t loopback_ip = 0x7f000001;

/// True for 224.0.0.0/4.
constexpr bool is_multicast(const Address& address) { return (address.ip >> 28) == 0xe; }
constexpr bool is_loopback(const Address& address) { return (address.ip >> 24) == 127; }

/// Text of the form "239.7.7.7:4750".
std::string to_text(const Address& address);
/// Text of the form "239.7.7.7".
std::string ip_text(std::uint32_t ip);

/// Reads "a.b.c.d:port"; `where` names the source of the text for the error ("rig.toml: network.group").
Expected<Address> parse_address(std::string_view text, std::string_view where);
/// Reads "a.b.c.d", in host byte order.
Expected<std::uint32_t> parse_ip(std::string_view text, std::string_view where);

}  // namespace septet::net
