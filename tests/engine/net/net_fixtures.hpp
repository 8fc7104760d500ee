#pragma once
// Shared by the network tests: keys from numbers, payloads from seeds, and a simulated site of one server and clients.

#include <memory>
#include <string>
#include <vector>

#include "engine/core/random.hpp"
#include "engine/net/secure_client.hpp"
#include "engine/net/secure_server.hpp"
#include "tests/engine/net/bad_network.hpp"
#include "tests/engine/net/simulated_machine.hpp"
#include "tests/engine/net/tick_wire.hpp"

namespace septet::net {

inline SessionId session_of(std::uint8_t number) {
  SessionId session{};
  session[0] = number;
  return session;
}

inline Bytes random_bytes(std::size_t size, std::uint64_t seed) {
  Random random(seed);
  Bytes bytes(size);
  for (std::byte& byte : bytes) byte = static_cast<std::byte>(random.next_bits());
  return bytes;
}

inline Bytes bytes_of(std::string_view text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

inline std::string text_of(const Bytes& bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

inline const Address server_address{0x0a000001, 4750};
inline Address client_address(std::uint32_t number) { return {0x0a000100 + number, 5000}; }

// One server and clients on a simulated network, each on a machine with a clock of its own; client n has identity 100 +
// n.
class Site {
 public:
  Site(std::size_t how_many, const NetworkFaults& faults, const ChannelLimits& limits = {})
      : limits_(limits),
        network(faults, 7),
        server_machine(machine_of_its_own(network, server_address.ip, server_address.ip, random_)),
        server_socket(server_machine->open(server_address.port)) {
    for (std::size_t n = 0; n < how_many; ++n)
      allowed.push_back({identity_of(client_key(n)).public_key(), "client-" + std::to_string(n)});
    start_server(1);
    for (std::size_t n = 0; n < how_many; ++n) add_client(n, client_key(n));
  }

  static std::uint8_t client_key(std::size_t n) { return static_cast<std::uint8_t>(100 + n); }
  void start_server(std::uint8_t session) {
    server = std::make_unique<SecureServer>(*server_socket,
                                            SecureServerOptions{identity_of(1), session_of(session), allowed, limits_});
  }
  void add_client(std::size_t n, std::uint8_t key) {
    if (client_sockets.size() <= n)
      client_machines.resize(n + 1), client_sockets.resize(n + 1), clients.resize(n + 1), hung.resize(n + 1);
    if (!client_sockets[n]) {
      const Address address = client_address(static_cast<std::uint32_t>(n));
      client_machines[n] = machine_of_its_own(network, address.ip, server_address.ip, random_);
      client_sockets[n] = client_machines[n]->open(address.port);
    }
    clients[n] = std::make_unique<SecureClient>(
        *client_sockets[n],
        SecureClientOptions{server_address, identity_of(1).public_key(), identity_of(key), limits_});
    received.resize(clients.size());
    client_events.resize(clients.size());
  }

  double server_clock_s() const { return server_machine->clock_s(now_s); }
  double client_clock_s(std::size_t n) const { return client_machines[n]->clock_s(now_s); }
  // Error of client n's estimate of the server's clock, in true time.
  double clock_error_s(std::size_t n) const {
    return clients[n]->clock().server_time_s(client_clock_s(n)) - server_clock_s();
  }

  // Advances everything by `duration_s` in steps of 1 ms.
  void run(double duration_s, double step_s = 0.001) {
    const double end_s = now_s + duration_s;
    while (now_s < end_s) {
      now_s += step_s;
      network.advance_to(now_s);
      if (server)
        for (ServerEvent& event : server->pump(server_clock_s())) server_events.push_back(std::move(event));
      network.advance_to(now_s);
      for (std::size_t n = 0; n < clients.size(); ++n) {
        if (!clients[n] || hung[n]) continue;
        for (ClientEvent& event : clients[n]->pump(client_clock_s(n))) {
          if (event.kind == ClientEvent::Kind::message) received[n].push_back(event.bytes);
          client_events[n].push_back(std::move(event));
        }
      }
    }
  }
  std::size_t count(ServerEvent::Kind kind) const {
    std::size_t result = 0;
    for (const ServerEvent& event : server_events) result += event.kind == kind;
    return result;
  }
  // The server's number for client n.
  ClientId id_of(std::size_t n) const {
    for (const ClientId id : server->clients())
      if (server->info(id)->address == client_address(static_cast<std::uint32_t>(n))) return id;
    return 0;
  }

 private:
  ChannelLimits limits_;
  Random random_{11};

 public:
  double now_s = 0.0;  // True time.
  BadNetwork network;
  std::unique_ptr<SimulatedMachine> server_machine;
  std::vector<std::unique_ptr<SimulatedMachine>> client_machines;
  std::unique_ptr<DatagramSocket> server_socket;
  std::vector<std::unique_ptr<DatagramSocket>> client_sockets;
  std::vector<AllowedClient> allowed;
  std::unique_ptr<SecureServer> server;
  std::vector<std::unique_ptr<SecureClient>> clients;
  std::vector<bool> hung;
  std::vector<ServerEvent> server_events;
  std::vector<std::vector<ClientEvent>> client_events;
  std::vector<std::vector<Bytes>> received;
};

}  // namespace septet::net
