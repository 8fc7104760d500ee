#include "engine/net/udp_socket.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "engine/net/multicast_probe.hpp"
#include "engine/net/tick_publisher.hpp"
#include "engine/net/tick_receiver.hpp"
#include "tests/engine/net/net_fixtures.hpp"

namespace septet::net {
namespace {

UdpSocket open_loopback() {
  auto socket = UdpSocket::open({.bind = {loopback_ip, 0}});
  REQUIRE(socket.has_value());
  return std::move(*socket);
}

TEST_CASE("addresses are read and written and bad ones say what to write") {
  CHECK(to_text(*parse_address("192.168.1.10:4750", "test")) == "192.168.1.10:4750");
  CHECK(*parse_ip("127.0.0.1", "test") == loopback_ip);
  for (const char* bad : {"", "1.2.3:4", "1.2.3.4", "1.2.3.4:", "1.2.3.256:1", "1.2.3.4:65536", "1.2.3.4:5x", "a:1"}) {
    const auto address = parse_address(bad, "rig.toml: network.server");
    REQUIRE_FALSE(address.has_value());
    CHECK(address.error().where == "rig.toml: network.server");
  }
}

TEST_CASE("datagrams cross a real loopback in both directions and waiting sees them") {
  UdpSocket a = open_loopback(), b = open_loopback();
  const UdpSocket* waiting[] = {&b};
  CHECK_FALSE(wait_readable(waiting, 0.0));
  for (std::uint64_t n = 0; n < 200; ++n) CHECK(a.send(b.local_address(), random_bytes(n * 7, n)));
  a.flush();
  REQUIRE(wait_readable(waiting, 60.0));
  std::uint64_t received = 0;
  while (const auto datagram = b.receive()) {
    CHECK(datagram->from == a.local_address());
    const Bytes expected = random_bytes(received * 7, received);
    CHECK(std::equal(expected.begin(), expected.end(), datagram->bytes.begin(), datagram->bytes.end()));
    ++received;
  }
  CHECK(received == 200);
}

TEST_CASE("a busy port gives one clear message") {
  UdpSocket first = open_loopback();
  const auto second = UdpSocket::open({.bind = first.local_address()});
  REQUIRE_FALSE(second.has_value());
  CHECK(second.error().what == "the port is in use by another program");
  CHECK(second.error().where == "udp " + to_text(first.local_address()));
  CHECK(second.error().remedy.find(std::to_string(first.local_address().port)) != std::string::npos);
}

TEST_CASE("an address of no interface of this machine gives one clear message") {
  const auto socket = UdpSocket::open({.bind = {0xcb007101, 0}});
  REQUIRE_FALSE(socket.has_value());
  CHECK(socket.error().remedy.find("ip -4 address") != std::string::npos);
}

TEST_CASE("the probe says that an address which is no group is none") {
  const MulticastProbe probe = probe_multicast({loopback_ip, 4750}, loopback_ip);
  CHECK_FALSE(probe.works);
  CHECK(probe.reason.find("not a group") != std::string::npos);
}

TEST_CASE("a tick reaches several sockets over real multicast") {
  const Address group{0xefffa54b, 47513};
  const MulticastProbe probe = probe_multicast(group, loopback_ip);
  if (!probe.works) {
    MESSAGE("skipped: " << probe.reason);
    return;
  }
  CHECK(probe.reason.find("came back") != std::string::npos);
  UdpSocket out = open_loopback();
  REQUIRE(out.set_multicast({.interface_ip = loopback_ip}).has_value());
  std::vector<UdpSocket> screens;
  for (int n = 0; n < 7; ++n) {
    auto socket = UdpSocket::open_group(group, loopback_ip);
    REQUIRE(socket.has_value());
    screens.push_back(std::move(*socket));
  }
  TickPublisher publisher(out, identity_of(1), session_of(1));
  publisher.add_destination(group);
  const Bytes payload = random_bytes(20000, 1);
  publisher.publish(1, payload);
  for (UdpSocket& screen : screens) {
    TickReceiver receiver(identity_of(1).public_key());
    receiver.follow(session_of(1));
    const UdpSocket* waiting[] = {&screen};
    CHECK(wait_readable(waiting, 60.0));
    receiver.receive_from(screen);
    REQUIRE(receiver.counters().ticks == 1);
    CHECK(receiver.next()->payload == payload);
  }
  CHECK(publisher.counters().datagrams < 25);
}

TEST_CASE("a server and a client connect and talk over real sockets") {
  UdpSocket server_end = open_loopback(), client_end = open_loopback();
  SecureServer server(server_end, {identity_of(1), session_of(1), {{identity_of(2).public_key(), "screen"}}, {}});
  SecureClient client(client_end, {server_end.local_address(), identity_of(1).public_key(), identity_of(2), {}});
  const Bytes content = random_bytes(300'000, 1);
  bool sent = false;
  Bytes got;
  for (int step = 0; step < 2000 && got.empty(); ++step) {
    const double now_s = step * 0.001;
    for (const ClientEvent& event : client.pump(now_s))
      if (event.kind == ClientEvent::Kind::message) got = event.bytes;
    server.pump(now_s);
    if (!sent && !server.clients().empty())
      sent = server.send(server.clients()[0], content, Reliability::reliable) == SendResult::queued;
  }
  CHECK(got == content);
}

}  // namespace
}  // namespace septet::net
