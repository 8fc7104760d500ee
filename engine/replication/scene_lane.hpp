#pragma once
/// Replication over the network's scene lane: a few lines between engine/net and both ends.
///
/// Only reliable messages belong to replication. A server or client that uses the lane for
/// something else too hands on the events that are replication's and keeps the rest.

#include <vector>

#include "engine/net/secure_client.hpp"
#include "engine/net/secure_server.hpp"
#include "engine/replication/replication_client.hpp"
#include "engine/replication/replication_server.hpp"

namespace septet::replication {

/// Takes one event of the lane; answers the changes that its client asks for. A client that breaks
/// the protocol is disconnected, with the reason.
std::vector<scene::Command> take_event(const net::ServerEvent& event, net::SecureServer& lane,
                                       ReplicationServer& scene);

/// Sends to every connected client; they share `bytes` (before packing), so that a tick is never
/// held up for longer.
void pump_clients(net::SecureServer& lane, ReplicationServer& scene, std::size_t bytes);

/// Takes one event of the lane; an error is to be logged, and is mended by itself.
Expected<void> take_event(const net::ClientEvent& event, ReplicationClient& scene);

void pump_client(net::SecureClient& lane, ReplicationClient& scene);

}  // namespace septet::replication
