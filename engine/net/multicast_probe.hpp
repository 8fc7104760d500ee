#pragma once
/// Probes whether multicast works on this machine's interface; machines, switches and loopbacks differ too much to
/// assume it.

#include <string>

#include "engine/net/address.hpp"

namespace septet::net {

struct MulticastProbe {
  bool works = false;
  std::string reason;  ///< Text for the operator: "multicast 239.7.7.7:4750 on 127.0.0.1 came back after 1 try".
};

/// Sends up to `tries` random probes to the group from one socket and listens on another of this machine, each for at
/// most `wait_s`. Success shows that sockets, routes and loopback work; reception by a distant screen is known to that
/// screen alone (PROTOCOL.md, "Choice of destination").
MulticastProbe probe_multicast(const Address& group, std::uint32_t interface_ip, int tries = 5, double wait_s = 0.02);

}  // namespace septet::net
