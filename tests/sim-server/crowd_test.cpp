#include <cstdint>
#include <functional>

#include <doctest/doctest.h>

#include "engine/net/secure_client.hpp"
#include "engine/replication/message.hpp"
#include "engine/scene/builder.hpp"
#include "sim-server/host/screen_host.hpp"
#include "tests/engine/net/simulated_machine.hpp"
#include "tests/engine/net/tick_wire.hpp"

namespace septet::server {
namespace {

/// The server's socket, before which the others go on talking while it reads.
struct LaneSocket final : net::DatagramSocket {
  explicit LaneSocket(std::unique_ptr<net::DatagramSocket> its_socket) : socket(std::move(its_socket)) {}
  bool send(const net::Address& to, std::span<const std::byte> bytes) override { return socket->send(to, bytes); }
  void flush() override { socket->flush(); }
  std::optional<net::ReceivedDatagram> receive() override {
    while (true) {
      if (auto datagram = socket->receive()) return datagram;
      if (interruptions == 0) return std::nullopt;
      --interruptions;
      socket->flush();
      talk();
    }
  }
  std::size_t receive_buffer_bytes() const override { return socket->receive_buffer_bytes(); }

  std::unique_ptr<net::DatagramSocket> socket;
  std::function<void()> talk;
  int interruptions = 0;
};

/// Screens as they start up, each on a machine with a clock of its own: they connect, introduce themselves and request
/// the scene.
struct Crowd {
  explicit Crowd(std::size_t count) {
    scene::SceneBuilder(store).add_object("post", {});
    ScreenHostOptions options{.identity = net::identity_of(0), .session = {1}, .allowed = {}};
    for (std::size_t who = 1; who <= count; ++who) {
      options.allowed.push_back(
          {net::identity_of(static_cast<std::uint8_t>(who)).public_key(), fmt::format("screen-{}", who)});
      options.screens.push_back(options.allowed.back().name);
    }
    lane.talk = [this] {
      now_s += 0.001;
      talk();
    };
    host = std::make_unique<ScreenHost>(lane, *tick, store, std::move(options));
    for (std::size_t who = 1; who <= count; ++who) {
      machines.push_back(net::machine_of_its_own(network, server_address.ip + static_cast<std::uint32_t>(who),
                                                 server_address.ip, random));
      sockets.push_back(machines.back()->open(5000));
      clients.push_back(std::make_unique<net::SecureClient>(
          *sockets.back(),
          net::SecureClientOptions{
              server_address, net::identity_of(0).public_key(), net::identity_of(static_cast<std::uint8_t>(who)), {}}));
    }
  }

  void talk() {
    network.advance_to(now_s);
    for (std::size_t i = 0; i < clients.size(); ++i)
      for (const net::ClientEvent& event : clients[i]->pump(machines[i]->clock_s(now_s)))
        if (event.kind == net::ClientEvent::Kind::connected) {
          ++connections;
          clients[i]->send(net::share(control::encode_control(control::Hello{fmt::format("screen-{}", i + 1), 5000})),
                           net::Reliability::reliable);
          clients[i]->send(net::share(control::scene_message(replication::encode(replication::Hello{}))),
                           net::Reliability::reliable);
        }
  }

  /// The screens run for a while without the server's reading; then it reads everything pending and arriving.
  void let_wait(double seconds) {
    for (const double until_s = now_s + seconds; now_s < until_s; now_s += 0.05) talk();
    lane.interruptions = 6;
    host->pump(server_machine->clock_s(now_s));
  }

  std::size_t live() const {
    std::size_t count = 0;
    for (const HostedScreen& screen : host->screens()) count += screen.live();
    return count;
  }

  net::BadNetwork network{{}, 1};
  Random random{5};
  net::Address server_address{0x0a000001, 4750};
  std::unique_ptr<net::SimulatedMachine> server_machine =
      net::machine_of_its_own(network, server_address.ip, server_address.ip, random);
  LaneSocket lane{server_machine->open(server_address.port)};
  std::unique_ptr<net::DatagramSocket> tick = server_machine->open(4999);
  scene::Store store;
  std::unique_ptr<ScreenHost> host;
  std::vector<std::unique_ptr<net::SimulatedMachine>> machines;
  std::vector<std::unique_ptr<net::DatagramSocket>> sockets;
  std::vector<std::unique_ptr<net::SecureClient>> clients;
  std::size_t connections = 0;
  double now_s = 1.0;  ///< True time.
};

}  // namespace

TEST_CASE("twenty-one screens that start at once before a busy server are all there") {
  // Screens repeat their hello after a second: a server busy for longer finds handshakes twice, and messages under the
  // first ones.
  for (const double busy_s : {0.1, 0.7, 1.3, 2.6}) {
    CAPTURE(busy_s);
    Crowd crowd(21);
    for (int turn = 0; turn < 6; ++turn) crowd.let_wait(busy_s);
    for (int turn = 0; turn < 100; ++turn) crowd.let_wait(0.05);
    CHECK(crowd.connections >= 21);
    CHECK(crowd.live() == 21);
  }
}

}  // namespace septet::server
