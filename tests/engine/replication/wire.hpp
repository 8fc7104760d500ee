#pragma once
/// A server and its clients joined by queues instead of a network.

#include <deque>
#include <memory>
#include <stdexcept>
#include <string>

#include "engine/replication/replication_client.hpp"
#include "engine/replication/replication_server.hpp"
#include "engine/scene/builder.hpp"

namespace septet::replication {

struct Wire {
  scene::Store store;
  std::unique_ptr<ReplicationServer> server;
  scene::SceneBuilder build;

  struct End {
    std::unique_ptr<ReplicationClient> client;
    ConnectionId connection = 0;  ///< 0: not connected.
    std::string identity;
    std::deque<Bytes> to_server, to_client;
    std::size_t bytes_to_client = 0, messages_to_client = 0, pumps = 0;
  };
  std::deque<End> ends;
  std::vector<scene::Command> requested;
  ConnectionId next_connection = 1;

  explicit Wire(ReplicationOptions options = {})
      : server(std::make_unique<ReplicationServer>(store, 1, options)),
        build(store, [this](const scene::Command& command) { server->applied(command); }) {}

  End& add(const std::string& identity, SubscriptionPolicy policy = {}) {
    End& end = ends.emplace_back();
    end.client = std::make_unique<ReplicationClient>(std::move(policy));
    end.identity = identity;
    connect(end);
    return end;
  }
  void connect(End& end) {
    end.connection = next_connection++;
    server->connect(end.connection, end.identity);
    end.client->connected();
  }
  /// Messages under way are lost.
  void cut(End& end) {
    server->disconnect(end.connection);
    end.client->disconnected();
    end.connection = 0;
    end.to_server.clear();
    end.to_client.clear();
  }

  /// Pumps each side of one end once, and delivers at most `messages` each way.
  void pump(End& end, std::size_t bytes = 1u << 20, std::size_t messages = ~std::size_t{0}) {
    if (end.connection == 0) return;
    ++end.pumps;
    const auto into = [](std::deque<Bytes>& queue) {
      return [&queue](std::span<const std::byte> message) {
        queue.emplace_back(message.begin(), message.end());
        return true;
      };
    };
    end.client->pump(into(end.to_server));
    for (std::size_t i = 0; i < messages && !end.to_server.empty(); ++i) {
      const auto batch = server->receive(end.connection, end.to_server.front());
      if (!batch) throw std::runtime_error(describe(batch.error()));
      requested.insert(requested.end(), batch->changes.begin(), batch->changes.end());
      end.to_server.pop_front();
    }
    const auto pumped = server->pump(end.connection, bytes, into(end.to_client));
    end.bytes_to_client += pumped.bytes;
    end.messages_to_client += pumped.messages;
    for (std::size_t i = 0; i < messages && !end.to_client.empty(); ++i) {
      const auto received = end.client->receive(end.to_client.front());
      if (!received) throw std::runtime_error(describe(received.error()));
      end.to_client.pop_front();
    }
  }

  /// Pumps until the client is complete up to the store's revision; false after too many pumps.
  bool settle(End& end, std::size_t bytes = 1u << 20) {
    for (int i = 0; i < 10000; ++i) {
      pump(end, bytes);
      if (end.client->complete() && end.client->complete_revision() == store.revision()) return true;
    }
    return false;
  }
};

}  // namespace septet::replication
