// The scene from the server to a screen's triangles.
#include <memory>

#include <benchmark/benchmark.h>

#include "engine/net/udp_socket.hpp"
#include "engine/scene/command_codec.hpp"
#include "engine/scene/resolve.hpp"
#include "sim-client/link/screen_link.hpp"
#include "sim-server/host/screen_host.hpp"
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
        sample_world(), [&](const scene::Command& command) { scene::encode(command, bytes); }, 8192);
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
BENCHMARK(decode_and_apply_world)->Name("scene/decode_and_apply_world")->Unit(benchmark::kMillisecond);

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
BENCHMARK(resolve_one_moved_object)->Name("scene/resolve_one_moved_object_of_4000")->Unit(benchmark::kMicrosecond);

/// From the first datagram to a complete mirror, over UDP on this machine, both ends on one thread.
void late_join_over_loopback(benchmark::State& state) {
  sample_world();
  const net::Identity server = net::Identity::generate(), client = net::Identity::generate();
  std::uint64_t bytes = 0;
  for (auto _ : state) {
    const net::UdpOptions any_port{.bind = {net::loopback_ip, 0}};
    auto server_lane = net::UdpSocket::open(any_port), server_tick = net::UdpSocket::open(any_port);
    auto screen_lane = net::UdpSocket::open(any_port), screen_tick = net::UdpSocket::open(any_port);
    if (!server_lane || !server_tick || !screen_lane || !screen_tick) return state.SkipWithError("no sockets");
    server::ScreenHost host(*server_lane, *server_tick, sample_world(),
                            {.identity = server, .allowed = {{client.public_key(), "screen"}}, .screens = {"screen"}});
    screen::ScreenLink link(
        *screen_lane, *screen_tick, {},
        {"screen", screen_tick->local_address().port, {server_lane->local_address(), server.public_key(), client, {}}});
    const auto start = std::chrono::steady_clock::now();
    while (!link.scene_arrived()) {
      const double now_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      host.pump(now_s);
      link.pump(now_s);
      if (now_s > 20.0) return state.SkipWithError("not complete after 20 s");
    }
    bytes = host.lane_counters().bytes_sent;
  }
  state.counters["bytes"] = static_cast<double>(bytes);
}
BENCHMARK(late_join_over_loopback)->Name("scene/late_join_over_loopback")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace septet::replication
