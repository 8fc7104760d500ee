// Costs of the network: one tick of each lane, the seal of a datagram, and a whole scene to seven clients.

#include <benchmark/benchmark.h>

#include <memory>

#include "engine/net/crypto.hpp"
#include "engine/net/secure_client.hpp"
#include "engine/net/secure_server.hpp"
#include "engine/net/tick_publisher.hpp"
#include "engine/net/tick_receiver.hpp"
#include "engine/net/udp_socket.hpp"
#include "tests/engine/net/tick_wire.hpp"

namespace septet::net {
namespace {

// Hash tree, signature and datagrams of one tick, without a socket.
void publish_tick(benchmark::State& state) {
  Recorder wire;
  TickPublisher publisher(wire, identity_of(1), SessionId{1});
  publisher.add_destination({loopback_ip, 1});
  const Bytes payload(static_cast<std::size_t>(state.range(0)), std::byte{5});
  std::uint64_t tick = 0;
  for (auto _ : state) {
    wire.datagrams.clear();
    publisher.publish(++tick, payload);
  }
  state.SetBytesProcessed(state.iterations() * state.range(0));
}
BENCHMARK(publish_tick)->Name("net/publish_tick")->Arg(4096)->Arg(65536);

// Signature, fragments and reassembly of one tick, repetitions included.
void receive_tick(benchmark::State& state) {
  constexpr std::uint64_t ticks = 256;
  Recorder wire;
  TickPublisher publisher(wire, identity_of(1), SessionId{1});
  publisher.add_destination({loopback_ip, 1});
  const Bytes payload(static_cast<std::size_t>(state.range(0)), std::byte{5});
  for (std::uint64_t tick = 1; tick <= ticks; ++tick) publisher.publish(tick, payload);
  std::int64_t received = 0;
  for (auto _ : state) {
    TickReceiver receiver(identity_of(1).public_key());
    receiver.follow(SessionId{1});
    for (const Bytes& datagram : wire.datagrams) {
      receiver.accept(datagram);
      while (receiver.next()) ++received;
    }
  }
  state.SetItemsProcessed(received);
}
BENCHMARK(receive_tick)->Name("net/receive_256_ticks")->Arg(4096)->Unit(benchmark::kMillisecond);

void seal_and_open(benchmark::State& state) {
  const Key32 key = random_key();
  const Bytes text(static_cast<std::size_t>(state.range(0)), std::byte{5}), header(15);
  Bytes sealed, opened;
  std::uint64_t number = 0;
  for (auto _ : state) {
    sealed.clear();
    seal(key, number, header, text, sealed);
    benchmark::DoNotOptimize(open(key, number++, header, sealed, opened));
  }
  state.SetBytesProcessed(state.iterations() * state.range(0));
}
BENCHMARK(seal_and_open)->Name("net/seal_and_open")->Arg(1169)->Arg(16384);

// A scene of 30 MB in 300 messages to seven clients over real loopback sockets, all eight ends in
// one thread. The argument is the datagram limit.
void send_scene(benchmark::State& state) {
  constexpr std::size_t screens = 7, messages = 300, message_bytes = 100'000;
  const SharedBytes message = share(Bytes(message_bytes, std::byte{5}));
  for (auto _ : state) {
    state.PauseTiming();
    ChannelLimits limits;
    limits.max_datagram_bytes = static_cast<std::size_t>(state.range(0));
    limits.timeout_s = 10.0;
    auto server_socket = UdpSocket::open({.bind = {loopback_ip, 0}});
    std::vector<AllowedClient> allowed;
    std::vector<UdpSocket> sockets;
    std::vector<std::unique_ptr<SecureClient>> clients;
    sockets.reserve(screens);
    for (std::uint8_t n = 0; n < screens; ++n) {
      const Identity identity = identity_of(static_cast<std::uint8_t>(10 + n));
      allowed.push_back({identity.public_key(), "screen"});
      sockets.push_back(std::move(*UdpSocket::open({.bind = {loopback_ip, 0}})));
      clients.push_back(std::make_unique<SecureClient>(
          sockets.back(),
          SecureClientOptions{server_socket->local_address(), identity_of(1).public_key(), identity, limits}));
    }
    SecureServer server(*server_socket, {identity_of(1), SessionId{1}, allowed, limits});
    double now_s = 0.0;
    std::size_t received = 0;
    const auto step = [&] {
      now_s += 0.001;
      server.pump(now_s);
      for (auto& client : clients)
        for (const ClientEvent& event : client->pump(now_s))
          if (event.kind == ClientEvent::Kind::message) ++received;
    };
    while (server.clients().size() < screens) step();
    state.ResumeTiming();
    for (const ClientId client : server.clients())
      for (std::size_t i = 0; i < messages; ++i) server.send(client, message, Reliability::reliable);
    while (received < screens * messages && now_s < 100.0) step();
    if (received < screens * messages) state.SkipWithError("not everything arrived");
    state.counters["resent"] = static_cast<double>(server.counters().resent);
    state.counters["pumps"] = now_s * 1000.0;
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(screens * messages * message_bytes));
}
BENCHMARK(send_scene)
    ->Name("net/send_30_MB_scene_to_7")
    ->Arg(1200)
    ->Arg(16384)
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace septet::net
