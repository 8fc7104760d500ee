#include "engine/net/channel.hpp"

#include <doctest/doctest.h>

#include "tests/engine/net/net_fixtures.hpp"

namespace septet::net {
namespace {

struct Buffer final : DatagramSocket {
  explicit Buffer(std::size_t buffer_bytes) : bytes(buffer_bytes) {}
  bool send(const Address&, std::span<const std::byte>) override { return true; }
  void flush() override {}
  std::optional<ReceivedDatagram> receive() override { return std::nullopt; }
  std::size_t receive_buffer_bytes() const override { return bytes; }
  std::size_t bytes;
};

TEST_CASE("an end announces a share of its buffer and datagrams that its network carries") {
  const Address lan = client_address(0), here{loopback_ip, 5000};
  const Buffer socket(6 << 20);
  ChannelLimits limits;
  limits.max_datagram_bytes = 0;
  limits.max_message_bytes = 77;
  limits.window_bytes = 123'456;
  CHECK(terms_of(limits, socket, lan, 1) == Terms{1200, 77, 123'456, 2 << 20});
  CHECK(terms_of(limits, socket, here, 1).max_datagram_bytes == 16384);
  CHECK(terms_of(limits, socket, lan, 8).flight_bytes == (2 << 20) / 8);
  CHECK(terms_of(limits, socket, lan, 0).flight_bytes == 2 << 20);
  CHECK(terms_of(limits, Buffer(1000), lan, 7).flight_bytes == 16 * 1024);
  limits.max_datagram_bytes = 9000;
  CHECK(terms_of(limits, socket, here, 1).max_datagram_bytes == 9000);
  limits.max_datagram_bytes = 1 << 20;
  CHECK(terms_of(limits, socket, lan, 1).max_datagram_bytes == 65507);
}

TEST_CASE("terms below what a connection needs are not usable") {
  const Terms least{576, 0, 16 * 1024, 4096};
  CHECK(are_usable(least));
  CHECK_FALSE(are_usable({575, 0, 16 * 1024, 4096}));
  CHECK_FALSE(are_usable({576, 0, 16 * 1024 - 1, 4096}));
  CHECK_FALSE(are_usable({576, 0, 16 * 1024, 4095}));
}

TEST_CASE("handshakes beyond fifty a second wait so that nobody keeps the server busy with them") {
  Site site(40, {});
  site.run(0.1);
  const std::size_t at_once = site.count(ServerEvent::Kind::connected);
  CHECK(at_once >= 8);
  CHECK(at_once <= 16);  // Ten at once, and five more in a tenth of a second.
  site.run(3.0);
  CHECK(site.count(ServerEvent::Kind::connected) == 40);
}

TEST_CASE("of transfers that fill the budget of a pump each has its turn") {
  ChannelLimits limits;
  limits.max_bytes_per_pump = 64 * 1024;
  Site site(3, {}, limits);
  site.run(0.1);
  for (std::size_t n = 0; n < 3; ++n) site.server->send(site.id_of(n), random_bytes(2 << 20, n), Reliability::reliable);
  site.run(0.150);
  // Each transfer ends only when the others are nearly done.
  for (std::size_t n = 0; n < 3; ++n) {
    const std::size_t queued = site.server->info(site.id_of(n))->queued_bytes;
    CHECK((queued > 0 || site.received[n].size() == 1));
  }
  const auto sent = [&](std::size_t n) { return site.server->info(site.id_of(n))->counters.bytes_sent; };
  const auto [least, most] = std::minmax({sent(0), sent(1), sent(2)});
  CHECK(least > most / 2);
}

TEST_CASE(
    "what a client sends without acknowledgement is bounded while it waits and has room again when it has gone out") {
  Site site(1, {});
  site.run(0.1);
  SecureClient& client = *site.clients[0];
  std::size_t taken = 0;
  while (client.send(random_bytes(1000, 1), Reliability::unreliable) == SendResult::queued) REQUIRE(++taken < 1000);
  CHECK(taken == 256 * 1024 / 1004);
  site.run(0.01);
  CHECK(client.send(random_bytes(1000, 1), Reliability::unreliable) == SendResult::queued);
}

}  // namespace
}  // namespace septet::net
