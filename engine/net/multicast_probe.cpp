#include "engine/net/multicast_probe.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "engine/net/crypto.hpp"
#include "engine/net/udp_socket.hpp"

namespace septet::net {

MulticastProbe probe_multicast(const Address& group, std::uint32_t interface_ip, int tries, double wait_s) {
  const std::string name = fmt::format("multicast {} on {}", to_text(group),
                                       interface_ip == 0 ? "the default interface" : ip_text(interface_ip));
  if (!is_multicast(group)) return {false, name + " is not a group (224.0.0.0 to 239.255.255.255)"};
  auto listener = UdpSocket::open_group(group, interface_ip);
  if (!listener) return {false, fmt::format("{} cannot be heard: {}", name, listener.error().what)};
  auto sender = UdpSocket::open({});
  if (!sender) return {false, fmt::format("{} cannot be sent to: {}", name, sender.error().what)};
  if (auto set = sender->set_multicast({.interface_ip = interface_ip}); !set)
    return {false, fmt::format("{} cannot be sent to: {}", name, set.error().what)};

  const Key32 probe = random_key();
  const auto bytes = as_bytes_of(probe);
  for (int attempt = 1; attempt <= tries; ++attempt) {
    sender->send(group, bytes);
    sender->flush();
    const UdpSocket* waiting[] = {&*listener};
    wait_readable(waiting, wait_s);
    while (const auto datagram = listener->receive())
      if (std::equal(datagram->bytes.begin(), datagram->bytes.end(), bytes.begin(), bytes.end()))
        return {true, fmt::format("{} came back at try {}", name, attempt)};
  }
  const std::string cause = sender->refused() > 0 ? " (the system refused to send: no route?)" : "";
  return {false, fmt::format("{} did not come back in {} tries{}", name, tries, cause)};
}

}  // namespace septet::net
