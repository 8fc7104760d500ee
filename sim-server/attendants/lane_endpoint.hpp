#pragma once
/// The server's end of both lanes: its key, the list of allowed clients, its sockets, and the transport of ticks.

#include <filesystem>
#include <vector>

#include "engine/control/control_message.hpp"
#include "engine/core/expected.hpp"
#include "engine/net/keys.hpp"
#include "engine/net/udp_socket.hpp"
#include "engine/rig/rig.hpp"
#include "program/console.hpp"

namespace septet::server {

struct LaneEndpoint {
  net::Identity identity;
  std::vector<net::AllowedClient> allowed;
  net::UdpSocket scene, tick;
};

/// `keys`: folder with server.key, which is created if missing, and allowed-clients. `any_port`: any free port instead
/// of the rig's. Error: a file cannot be read, an address is not this machine's, or the port is taken.
Expected<LaneEndpoint> open_lane_endpoint(const std::filesystem::path& keys, const rig::Rig& rig, bool any_port);

/// Chooses multicast if the rig requests it, or if the rig leaves the choice and this machine's loopback carries
/// multicast; `welcome` tells the screens.
Expected<void> choose_transport(const rig::Network& network, LaneEndpoint& endpoint, bool any_port,
                                control::Welcome& welcome, program::ProgressLine& line);

}  // namespace septet::server
