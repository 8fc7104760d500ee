#include <doctest/doctest.h>

#include "engine/net/bad_network.hpp"
#include "engine/replication/scene_lane.hpp"
#include "tests/engine/replication/sample_world.hpp"

using namespace septet;
using namespace septet::replication;

namespace {

net::Identity identity_of(std::uint8_t number) {
  std::array<std::uint8_t, 32> seed{};
  seed[0] = number;
  return net::Identity::from_seed(seed);
}

constexpr net::Address server_address{0x0a000001, 4750}, screen_address{0x0a000002, 5000};
constexpr double tick_s = 1.0 / 120.0;

}  // namespace

TEST_CASE("a screen that joins late has the whole world within one simulated second") {
  scene::Store store;
  scene::SceneBuilder build(store);
  build_sample_world(build);

  for (const double loss : {0.0, 0.01}) {
    CAPTURE(loss);
    net::BadNetwork network({.loss = loss, .latency_s = 0.0003}, 5);
    const auto server_socket = network.open(server_address),
               screen_socket = network.open(screen_address);
    net::SecureServerOptions options{
        identity_of(1), {}, {{identity_of(2).public_key(), "screen"}}, {}};
    net::SecureServer server_lane(*server_socket, std::move(options));
    ReplicationServer server(store, 1);
    net::SecureClient screen_lane(
        *screen_socket, {server_address, identity_of(1).public_key(), identity_of(2), {}});
    ReplicationClient screen;

    double now_s = 0.0;
    int steps = 0;
    // The server pumps four times a tick, the screen as often as it waits for its frame.
    for (; steps < 2000 && !screen.complete(); ++steps) {
      now_s += tick_s / 4;
      network.advance_to(now_s);
      for (const auto& event : server_lane.pump(now_s)) take_event(event, server_lane, server);
      if (steps % 4 == 0) pump_clients(server_lane, server, 256 * 1024);
      network.advance_to(now_s);
      for (const auto& event : screen_lane.pump(now_s))
        REQUIRE(take_event(event, screen).has_value());
      pump_client(screen_lane, screen);
    }
    CHECK(now_s < 1.0);
    CHECK(screen.complete_revision() == store.revision());
    CHECK(same_content(screen.store(), store));
    const auto sent = network.sent_by(server_address);
    MESSAGE("loss ", loss, ": complete after ", now_s, " s and ", sent.bytes, " bytes in ",
            sent.datagrams, " datagrams");
    CHECK(sent.bytes < 10'000'000);
  }
}
