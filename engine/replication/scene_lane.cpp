#include "engine/replication/scene_lane.hpp"

#include <algorithm>

namespace septet::replication {
namespace {

/// What may wait in the lane for one client; replication keeps the rest, where it is overwritten by
/// what is newer.
constexpr std::size_t lane_queue_bytes = 1u << 20;

bool was_taken(net::SendResult result) {
  return result == net::SendResult::queued || result == net::SendResult::overwrote;
}

}  // namespace

std::vector<scene::Command> take_event(const net::ServerEvent& event, net::SecureServer& lane,
                                       ReplicationServer& scene) {
  switch (event.kind) {
    case net::ServerEvent::Kind::connected: {
      const net::ClientInfo* info = lane.info(event.client);
      // A client that is gone again by now has its event `disconnected` behind this one.
      scene.connect(event.client, info ? net::to_text(info->key) : std::string());
      return {};
    }
    case net::ServerEvent::Kind::disconnected:
      scene.disconnect(event.client);
      return {};
    case net::ServerEvent::Kind::refused: return {};
    case net::ServerEvent::Kind::message: {
      if (event.reliability != net::Reliability::reliable || !scene.knows(event.client)) return {};
      auto changes = scene.receive(event.client, event.bytes);
      if (changes) return std::move(*changes);
      scene.disconnect(event.client);
      lane.disconnect(event.client, describe(changes.error()));
      return {};
    }
  }
  return {};
}

void pump_clients(net::SecureServer& lane, ReplicationServer& scene, std::size_t bytes) {
  const std::vector<net::ClientId> clients = lane.clients();
  const std::size_t share = bytes / std::max<std::size_t>(1, clients.size());
  for (const net::ClientId client : clients) {
    const net::ClientInfo* info = lane.info(client);
    if (!info || info->queued_bytes > lane_queue_bytes || !scene.knows(client)) continue;
    scene.pump(client, share, [&](std::span<const std::byte> message) {
      return was_taken(lane.send(client, message, net::Reliability::reliable));
    });
  }
}

Expected<void> take_event(const net::ClientEvent& event, ReplicationClient& scene) {
  switch (event.kind) {
    case net::ClientEvent::Kind::connected:
      scene.connected();
      return {};
    case net::ClientEvent::Kind::lost:
      scene.disconnected();
      return {};
    case net::ClientEvent::Kind::message:
      if (event.reliability != net::Reliability::reliable) return {};
      return scene.receive(event.bytes);
  }
  return {};
}

void pump_client(net::SecureClient& lane, ReplicationClient& scene) {
  if (lane.state() != net::ClientState::connected) return;
  scene.pump([&](std::span<const std::byte> message) {
    return was_taken(lane.send(message, net::Reliability::reliable));
  });
}

}  // namespace septet::replication
