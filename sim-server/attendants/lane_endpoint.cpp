#include "sim-server/attendants/lane_endpoint.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include <fmt/core.h>

#include "engine/net/multicast_probe.hpp"

namespace septet::server {
namespace {

/// True if all screens of the rig, and its car, run on this machine.
bool is_one_machine(const rig::Rig& rig) {
  return rig.network.server_address == "127.0.0.1" && rig.car.machine.empty() &&
         std::ranges::all_of(rig.screens, [](const auto& screen) { return screen.machine.empty(); });
}

}  // namespace

Expected<LaneEndpoint> open_lane_endpoint(const std::filesystem::path& keys, const rig::Rig& rig, bool any_port) {
  auto identity = net::load_or_create_identity(keys / "server.key");
  if (!identity) return tl::unexpected(identity.error());
  auto allowed = net::load_allowed_clients(keys / "allowed-clients");
  if (!allowed) return tl::unexpected(allowed.error());
  std::uint32_t ip = is_one_machine(rig) ? net::loopback_ip : 0;
  if (!rig.network.interface_address.empty()) {
    const auto parsed = net::parse_ip(rig.network.interface_address, "rig, network.interface_address");
    if (!parsed) return tl::unexpected(parsed.error());
    ip = *parsed;
  }
  auto scene = net::UdpSocket::open({{ip, any_port ? std::uint16_t{0} : rig.network.scene_port}});
  if (!scene) return tl::unexpected(scene.error());
  auto tick = net::UdpSocket::open({{ip, 0}});
  if (!tick) return tl::unexpected(tick.error());
  return LaneEndpoint{*identity, std::move(*allowed), std::move(*scene), std::move(*tick)};
}

Expected<void> choose_transport(const rig::Network& network, LaneEndpoint& endpoint, bool any_port,
                                control::Welcome& welcome, program::ProgressLine& line) {
  if (network.transport == rig::TickTransport::unicast) return {};
  const auto group_ip = net::parse_ip(network.tick_group, "rig, network.tick_group");
  if (!group_ip) return tl::unexpected(group_ip.error());
  const std::uint32_t interface_ip = endpoint.tick.local_address().ip;
  // Two drives on one machine must not hear each other's group: the port follows the scene lane's.
  const auto port = any_port ? static_cast<std::uint16_t>(endpoint.scene.local_address().port ^ 1u) : network.tick_port;
  const net::Address group{*group_ip, port};
  if (network.transport == rig::TickTransport::automatic) {
    const auto probe = net::probe_multicast(group, interface_ip);
    line.message(fmt::format("tick lane: {} ({})", probe.works ? "multicast" : "unicast", probe.reason));
    if (!probe.works) return {};
  }
  if (auto set = endpoint.tick.set_multicast({interface_ip, 1, true}); !set) return set;
  welcome.group_ip = group.ip;
  welcome.group_port = group.port;
  welcome.interface_ip = interface_ip;
  return {};
}

}  // namespace septet::server
