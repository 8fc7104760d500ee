// The scene on its way from the server to a screen's triangles.
#include <memory>

#include <benchmark/benchmark.h>

#include "engine/net/udp_socket.hpp"
#include "engine/replication/scene_lane.hpp"
#include "engine/scene/command_codec.hpp"
#include "engine/scene/resolve.hpp"
#include "tests/engine/replication/sample_world.hpp"

namespace septet::replication {
namespace {

const scene::Store& sample_world() {
  static const scene::Store store = [] {
    scene::Store made;
    scene::SceneBuilder build(made);
    build_sample_world(build);
    return made;
  }();
  return store;
}

const Bytes& sample_bytes() {
  static const Bytes bytes = [] {
    Bytes made;
    scene::describe_store(
        sample_world(), [&](const scene::Command& command) { scene::encode(command, made); }, 8192);
    return made;
  }();
  return bytes;
}

void encode_world(benchmark::State& state) {
  sample_world();
  Bytes bytes;
  for (auto _ : state) {
    bytes.clear();
    scene::describe_store(
        sample_world(), [&](const scene::Command& command) { scene::encode(command, bytes); },
        8192);
  }
  state.counters["bytes"] = static_cast<double>(bytes.size());
}
BENCHMARK(encode_world)->Name("scene/encode_world")->Unit(benchmark::kMillisecond);

void decode_and_apply_world(benchmark::State& state) {
  const Bytes& bytes = sample_bytes();
  for (auto _ : state) {
    scene::Store store;
    ByteReader in(bytes);
    while (!in.at_end()) (void)store.apply(*scene::decode(in));
    benchmark::DoNotOptimize(store.revision());
  }
}
BENCHMARK(decode_and_apply_world)
    ->Name("scene/decode_and_apply_world")
    ->Unit(benchmark::kMillisecond);

void resolve_world(benchmark::State& state) {
  sample_world();
  for (auto _ : state) benchmark::DoNotOptimize(scene::resolve(sample_world()).revision);
}
BENCHMARK(resolve_world)->Name("scene/resolve_world")->Unit(benchmark::kMillisecond);

void resolve_one_moved_object(benchmark::State& state) {
  scene::Store store = sample_world();
  scene::Resolver resolver;
  resolver.update(store);
  const scene::NodeId moved = store.nodes().rbegin()->first;
  double x = 0.0;
  for (auto _ : state) {
    (void)store.apply(scene::TransformSet{moved, {{x += 1.0, 0, 0}}});
    resolver.update(store);
  }
}
BENCHMARK(resolve_one_moved_object)
    ->Name("scene/resolve_one_moved_object_of_4000")
    ->Unit(benchmark::kMicrosecond);

/// From the first datagram to a complete mirror, over UDP on this machine, both ends on one thread.
void late_join_over_loopback(benchmark::State& state) {
  sample_world();
  const auto identity_of = [](std::uint8_t number) {
    std::array<std::uint8_t, 32> seed{};
    seed[0] = number;
    return net::Identity::from_seed(seed);
  };
  std::uint64_t bytes = 0;
  double now_s = 0.0;
  for (auto _ : state) {
    auto server_socket = net::UdpSocket::open({.bind = {net::loopback_ip, 0}});
    auto screen_socket = net::UdpSocket::open({.bind = {net::loopback_ip, 0}});
    if (!server_socket || !screen_socket) return state.SkipWithError("no sockets");
    net::SecureServer server_lane(
        *server_socket, {identity_of(1), {}, {{identity_of(2).public_key(), "screen"}}, {}});
    net::SecureClient screen_lane(
        *screen_socket,
        {server_socket->local_address(), identity_of(1).public_key(), identity_of(2), {}});
    ReplicationServer server(sample_world(), 1);
    ReplicationClient screen;
    const auto start = std::chrono::steady_clock::now();
    while (!screen.complete()) {
      now_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      for (const auto& event : server_lane.pump(now_s)) take_event(event, server_lane, server);
      pump_clients(server_lane, server, 256 * 1024);
      for (const auto& event : screen_lane.pump(now_s)) (void)take_event(event, screen);
      pump_client(screen_lane, screen);
      if (now_s > 20.0) return state.SkipWithError("not complete after 20 s");
    }
    bytes = server_lane.counters().bytes_sent;
  }
  state.counters["bytes"] = static_cast<double>(bytes);
}
BENCHMARK(late_join_over_loopback)
    ->Name("scene/late_join_over_loopback")
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace septet::replication
