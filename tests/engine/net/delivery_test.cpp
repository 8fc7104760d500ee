#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/engine/net/net_fixtures.hpp"

namespace septet::net {
namespace {

const NetworkFaults bad_lan{.loss = 0.05, .duplication = 0.02, .latency_s = 0.0003, .jitter_s = 0.020};

TEST_CASE(
    "at five percent loss with jitter and reordering every reliable message arrives once and in "
    "order") {
  Site site(1, bad_lan);
  site.run(0.5);
  REQUIRE(site.clients[0]->state() == ClientState::connected);
  const ClientId id = site.id_of(0);
  std::vector<Bytes> sent;
  for (std::uint64_t n = 0; n < 300; ++n) {
    sent.push_back(random_bytes(n % 50 == 0 ? 20000 : n % 40, n));
    CHECK(site.server->send(id, sent.back(), Reliability::reliable) == SendResult::queued);
    CHECK(site.clients[0]->send(sent.back(), Reliability::reliable) == SendResult::queued);
    site.run(0.003);
  }
  site.run(1.0);
  CHECK(site.received[0] == sent);
  std::vector<Bytes> at_server;
  for (ServerEvent& event : site.server_events)
    if (event.kind == ServerEvent::Kind::message) at_server.push_back(event.bytes);
  CHECK(at_server == sent);
  CHECK(site.server->info(id)->queued_bytes == 0);
  CHECK(site.server->info(id)->counters.resent > 0);
  CHECK(site.count(ServerEvent::Kind::disconnected) == 0);
}

TEST_CASE("a message of several megabytes arrives unchanged through a bad network") {
  Site site(1, bad_lan);
  site.run(0.5);
  const Bytes large = random_bytes(2 << 20, 1);
  site.server->send(site.id_of(0), large, Reliability::reliable);
  site.run(8.0, 0.005);
  REQUIRE(site.received[0].size() == 1);
  CHECK(site.received[0][0] == large);
}

TEST_CASE("no datagram of the scene lane exceeds 1200 bytes unless both ends allow more") {
  for (const std::size_t limit : {0u, 600u, 9000u}) {
    ChannelLimits limits;
    limits.max_datagram_bytes = limit;
    Site site(1, {}, limits);
    site.run(0.1);
    site.server->send(site.id_of(0), random_bytes(200'000, 1), Reliability::reliable);
    site.run(0.1);
    REQUIRE(site.received[0].size() == 1);
    CHECK(site.network.sent_by(server_address).largest_bytes == (limit == 0 ? 1200 : limit));
  }
}

TEST_CASE("what is lost is resent within ten milliseconds on a local network") {
  Site site(1, {});
  site.run(1.0);
  site.server->send(site.id_of(0), bytes_of("warm up"), Reliability::reliable);
  site.run(0.05);
  site.network.set_faults({.loss = 1.0});
  site.server->send(site.id_of(0), bytes_of("lost at first"), Reliability::reliable);
  site.run(0.001);
  site.network.set_faults({});
  site.run(0.010);
  REQUIRE(site.received[0].size() == 2);
  CHECK(text_of(site.received[0][1]) == "lost at first");
}

TEST_CASE("unreliable messages arrive at most once and never without authentication") {
  Site site(1, {.duplication = 0.5});
  site.run(0.2);
  for (std::uint64_t n = 0; n < 100; ++n) {
    site.clients[0]->send(random_bytes(20, n), Reliability::unreliable);
    site.run(0.001);
  }
  site.run(0.05);
  CHECK(site.count(ServerEvent::Kind::message) == 100);
  CHECK(site.server->counters().replayed > 0);
  CHECK(site.clients[0]->send(random_bytes(1200, 1), Reliability::unreliable) == SendResult::too_large);
}

TEST_CASE("a client whose queue is full is dropped so that memory is bounded") {
  ChannelLimits limits;
  limits.max_queue_bytes = 100'000;
  Site site(2, {}, limits);
  site.run(0.1);
  const ClientId first = site.id_of(0), second = site.id_of(1);
  site.hung[0] = true;
  SendResult result = SendResult::queued;
  for (int n = 0; n < 11 && result == SendResult::queued; ++n)
    result = site.server->send(first, random_bytes(10'000, 1), Reliability::reliable);
  CHECK(result == SendResult::queue_full);
  site.run(0.01);
  CHECK(!site.server->info(first));
  CHECK(site.server->info(second));
}

TEST_CASE("random truncated and altered datagrams change nothing and are counted") {
  Site site(1, {});
  site.run(0.2);
  auto attacker = site.network.open(client_address(50));
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Bytes noise = random_bytes(seed * 4, seed);
    attacker->send(server_address, noise);
    attacker->send(client_address(0), noise);
    if (noise.size() > 3) {
      noise[0] = std::byte{0x53}, noise[1] = std::byte{1}, noise[2] = static_cast<std::byte>(1 + seed % 5);
      attacker->send(server_address, noise);
    }
  }
  site.server->send(site.id_of(0), bytes_of("still here"), Reliability::reliable);
  site.run(0.1);
  const ChannelCounters counters = site.server->counters();
  CHECK(counters.malformed + counters.unknown + counters.bad_cookies + counters.forged >= 590);
  CHECK(site.clients[0]->counters().unknown == 300);
  CHECK(site.server->clients().size() == 1);
  REQUIRE(site.received[0].size() == 1);
  CHECK(text_of(site.received[0][0]) == "still here");
}

TEST_CASE("a transfer to one client does not hold up another one") {
  ChannelLimits limits;
  limits.max_bytes_per_pump = 128 * 1024;
  Site site(2, {}, limits);
  site.run(0.1);
  site.server->send(site.id_of(0), random_bytes(8 << 20, 1), Reliability::reliable);
  site.run(0.01);
  CHECK(site.server->has_backlog());
  site.server->send(site.id_of(1), bytes_of("small"), Reliability::reliable);
  site.run(0.004);
  CHECK(site.received[0].empty());
  CHECK(site.received[1].size() == 1);
}

}  // namespace
}  // namespace septet::net
