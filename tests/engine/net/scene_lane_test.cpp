#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/engine/net/net_fixtures.hpp"

namespace septet::net {
namespace {

const NetworkFaults bad_lan{.loss = 0.05, .duplication = 0.02, .latency_s = 0.0003, .jitter_s = 0.020};

TEST_CASE("an allowed client connects and both sides know each other") {
  Site site(2, {});
  site.run(0.1);
  REQUIRE(site.count(ServerEvent::Kind::connected) == 2);
  CHECK(site.clients[0]->state() == ClientState::connected);
  CHECK(site.clients[0]->session() == session_of(1));
  CHECK(site.server->info(site.id_of(1))->name == "client-1");
  CHECK(site.server->counters().forged + site.server->counters().malformed == 0);
}

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

TEST_CASE("a message not yet sent is overwritten by a newer one with its key and keeps its place") {
  Site site(1, {});
  site.run(0.1);
  const ClientId id = site.id_of(0);
  const auto send = [&](const char* text, AddressKey key) {
    return site.server->send(id, bytes_of(text), Reliability::reliable, key);
  };
  CHECK(send("pose 1", 7) == SendResult::queued);
  CHECK(send("name", no_address_key) == SendResult::queued);
  CHECK(send("other pose", 8) == SendResult::queued);
  CHECK(send("pose 2", 7) == SendResult::overwrote);
  CHECK(send("pose 3", 7) == SendResult::overwrote);
  site.run(0.05);
  REQUIRE(site.received[0].size() == 3);
  CHECK(text_of(site.received[0][0]) == "pose 3");
  CHECK(text_of(site.received[0][1]) == "name");
  CHECK(text_of(site.received[0][2]) == "other pose");
  CHECK(send("pose 4", 7) == SendResult::queued);
  site.run(0.05);
  CHECK(text_of(site.received[0].back()) == "pose 4");
}

TEST_CASE("under loss the newest message of every key arrives last whatever was overwritten") {
  Site site(1, {.loss = 0.3, .latency_s = 0.001, .jitter_s = 0.005});
  site.run(1.0);
  const ClientId id = site.id_of(0);
  REQUIRE(id != 0);
  for (int n = 0; n < 500; ++n) {
    const AddressKey key = 1 + static_cast<AddressKey>(n % 3);
    site.server->send(id, bytes_of(std::to_string(key) + " " + std::to_string(n)), Reliability::reliable, key);
    site.run(0.002);
  }
  site.run(2.0);
  CHECK(site.server->counters().overwritten > 0);
  CHECK(site.server->info(id)->queued_bytes == 0);
  std::array<int, 4> last{};
  for (const Bytes& message : site.received[0]) {
    const std::string text = text_of(message);
    const int key = text[0] - '0', n = std::stoi(text.substr(2));
    CHECK(n > last[static_cast<std::size_t>(key)] - 1);
    last[static_cast<std::size_t>(key)] = n;
  }
  CHECK(last == std::array<int, 4>{0, 498, 499, 497});
}

TEST_CASE("a client that is not on the list learns that and no more and the operator learns its key") {
  Site site(1, {});
  site.add_client(1, 200);
  site.run(2.0);
  CHECK(site.clients[0]->state() == ClientState::connected);
  CHECK(site.clients[1]->state() == ClientState::connecting);
  CHECK(site.received[1].empty());
  CHECK(site.client_events[1].empty());
  CHECK(site.clients[1]->obstacle() == Obstacle::key_unknown);
  CHECK(site.clients[0]->obstacle() == Obstacle::none);
  CHECK(site.server->counters().not_allowed > 0);
  const auto refused = std::find_if(site.server_events.begin(), site.server_events.end(),
                                    [](const auto& event) { return event.kind == ServerEvent::Kind::refused; });
  REQUIRE(refused != site.server_events.end());
  CHECK(refused->reason.find(to_text(identity_of(200).public_key())) != std::string::npos);
  // Without end, but rarely: at most every five seconds, and the operator is told every half minute.
  site.run(60.0, 0.01);
  const auto knocks = site.server->counters().not_allowed;
  site.run(60.0, 0.01);
  CHECK(site.server->counters().not_allowed - knocks >= 11);
  CHECK(site.server->counters().not_allowed - knocks <= 13);
  CHECK(site.count(ServerEvent::Kind::refused) <= 5);
  site.allowed.push_back({identity_of(200).public_key(), "late"});
  site.server->set_allowed(site.allowed);
  site.run(6.0, 0.01);
  CHECK(site.clients[1]->state() == ClientState::connected);
  CHECK(site.clients[1]->obstacle() == Obstacle::none);
}

TEST_CASE("a client does not connect to a server with another key than the pinned one") {
  Site site(1, {});
  site.clients[0] = std::make_unique<SecureClient>(
      *site.client_sockets[0], SecureClientOptions{server_address, identity_of(99).public_key(), identity_of(100), {}});
  site.run(1.0);
  CHECK(site.clients[0]->state() == ClientState::connecting);
  CHECK(site.server->clients().empty());
  site.run(5.0);
  CHECK(site.clients[0]->obstacle() == Obstacle::other_server_key);
  CHECK(site.server->counters().forged > 0);
}

TEST_CASE("a server that reads seldom is not taken for another one") {
  Site site(1, {});
  for (int turn = 0; turn < 2; ++turn) {
    auto busy = std::move(site.server);
    site.run(1.8);
    site.server = std::move(busy);
    CHECK(site.clients[0]->obstacle() != Obstacle::other_server_key);
    site.run(0.002);
  }
  site.run(0.1);
  CHECK(site.clients[0]->state() == ClientState::connected);
}

TEST_CASE("a client says that nobody answers and goes on when somebody does") {
  Site site(1, {});
  site.server.reset();
  site.run(1.0);
  CHECK(site.clients[0]->obstacle() == Obstacle::none);  // It has not tried for long.
  site.run(30.0, 0.01);
  CHECK(site.clients[0]->obstacle() == Obstacle::no_answer);
  const auto before = site.network.sent_by(client_address(0)).datagrams;
  site.run(10.0, 0.01);
  CHECK(site.network.sent_by(client_address(0)).datagrams - before <= 11);
  site.start_server(1);
  site.run(1.2);
  CHECK(site.clients[0]->state() == ClientState::connected);
  CHECK(site.clients[0]->obstacle() == Obstacle::none);
}

TEST_CASE("what speaks another version of the protocol is told which one is spoken here") {
  Site site(0, {});
  const auto stranger = site.network.open({0x0a000200, 6000});
  Bytes hello = random_bytes(35, 1);
  hello[0] = std::byte{0x53}, hello[1] = std::byte{2}, hello[2] = std::byte{1};
  stranger->send(server_address, hello);
  site.run(0.01);
  const auto answer = stranger->receive();
  REQUIRE(answer);
  CHECK(answer->bytes.size() < hello.size());
  CHECK(answer->bytes[0] == hello[0]);
  CHECK(answer->bytes[1] == std::byte{1});
  // And the other way round: the server is of another version.
  site.server.reset();
  site.add_client(0, 100);
  for (int i = 0; i < 100; ++i) {
    site.run(0.02);
    const Bytes other{std::byte{0x53}, std::byte{2}, std::byte{6}};
    site.server_socket->send(client_address(0), other);
  }
  CHECK(site.clients[0]->state() == ClientState::connecting);
  CHECK(site.clients[0]->obstacle() == Obstacle::other_version);
}

TEST_CASE(
    "of two clients with one key the one that is alive stays and the other one learns why and takes over when it is "
    "gone") {
  Site site(1, {});
  site.run(0.2);
  const ClientId first = site.id_of(0);
  site.add_client(1, Site::client_key(0));
  for (int i = 0; i < 10; ++i) {
    site.run(1.0);
    CHECK(site.server->clients() == std::vector{first});
    CHECK(site.clients[0]->state() == ClientState::connected);
    CHECK(site.clients[1]->obstacle() == Obstacle::key_in_use);
  }
  CHECK(site.count(ServerEvent::Kind::connected) == 1);
  CHECK(site.count(ServerEvent::Kind::refused) == 1);
  // Its machine has lost its power: nothing is said any more.
  site.hung[0] = true;
  site.run(3.0);
  CHECK(site.clients[1]->state() == ClientState::connected);
  CHECK(site.clients[1]->obstacle() == Obstacle::none);
}

TEST_CASE("a client that was started anew elsewhere is back within a second") {
  Site site(1, {});
  site.run(2.0);
  site.hung[0] = true;
  site.add_client(1, Site::client_key(0));
  site.run(0.9);
  CHECK(site.clients[1]->state() == ClientState::connected);
}

TEST_CASE("a client is not taken for silent while the server was busy itself") {
  Site site(1, {});
  site.run(0.2);
  const ClientId first = site.id_of(0);
  site.add_client(1, Site::client_key(0));
  site.run(0.3);
  // For a while the clients talk and nobody reads.
  auto busy = std::move(site.server);
  site.run(0.9);
  site.server = std::move(busy);
  site.run(0.5);
  CHECK(site.server->clients() == std::vector{first});
  CHECK(site.count(ServerEvent::Kind::connected) == 1);
}

TEST_CASE("a client taken off the list is dropped") {
  Site site(2, {});
  site.run(0.1);
  site.server->set_allowed({site.allowed[1]});
  site.run(0.5);
  CHECK(site.server->clients() == std::vector{site.id_of(1)});
  CHECK(site.clients[0]->state() == ClientState::lost);
  CHECK(site.client_events[0].back().reason == "the server said goodbye: it is no longer allowed");
  CHECK(site.clients[0]->obstacle() == Obstacle::key_unknown);
  // A key that stands under another name is another client.
  site.server->set_allowed({{site.allowed[1].key, "renamed"}});
  site.run(0.01);
  CHECK(site.client_events[1].back().reason == "the server said goodbye: it is no longer allowed");
  site.run(0.5);
  REQUIRE(site.server->clients().size() == 1);
  CHECK(site.server->info(site.server->clients().front())->name == "renamed");
}

TEST_CASE("a hung client costs the others nothing and is dropped") {
  Site site(7, {});
  site.run(0.2);
  REQUIRE(site.server->clients().size() == 7);
  site.hung[3] = true;
  const ClientId hung = site.id_of(3);
  for (std::uint64_t n = 0; n < 300; ++n) {
    const SharedBytes message = share(random_bytes(5000, n));
    for (const ClientId id : site.server->clients()) site.server->send(id, message, Reliability::reliable);
    site.run(0.01);
    for (std::size_t client = 0; client < 7; ++client) {
      if (client != 3) REQUIRE(site.received[client].size() + 1 >= n);
    }
  }
  CHECK(site.count(ServerEvent::Kind::disconnected) == 1);
  CHECK(!site.server->info(hung));
  site.hung[3] = false;
  site.run(0.5);
  CHECK(site.clients[3]->state() == ClientState::connected);
  CHECK(site.server->clients().size() == 7);
}

TEST_CASE("a client that was busy does not take the server for silent but one that asks in vain does") {
  Site site(1, {});
  site.run(3.0);
  site.hung[0] = true;
  site.run(1.5);
  site.hung[0] = false;
  for (int step = 0; step < 300; ++step) {
    site.run(0.001);
    CHECK(site.clients[0]->silence_s() < 0.05);
  }
  site.server.reset();
  site.run(1.5);
  CHECK(site.clients[0]->silence_s() > 1.2);
  CHECK(site.clients[0]->silence_s() <= 1.5);
}

TEST_CASE("a client that is busy for longer than its patience again and again keeps its connection") {
  Site site(1, {});
  site.run(0.5);
  for (int picture = 0; picture < 8; ++picture) {
    site.hung[0] = true;
    site.run(1.3);
    site.hung[0] = false;
    site.run(0.001);
  }
  site.run(0.2);
  CHECK(site.count(ServerEvent::Kind::connected) == 1);
  CHECK(site.count(ServerEvent::Kind::disconnected) == 0);
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

TEST_CASE("a client reconnects by itself when the server restarts and learns the new session") {
  Site site(2, {});
  site.run(0.2);
  site.server.reset();
  site.run(0.5);
  site.start_server(2);
  site.run(2.5);
  for (std::size_t n = 0; n < 2; ++n) {
    CHECK(site.clients[n]->state() == ClientState::connected);
    CHECK(site.clients[n]->session() == session_of(2));
    REQUIRE(site.client_events[n].size() == 3);
    CHECK(site.client_events[n][1].kind == ClientEvent::Kind::lost);
  }
}

TEST_CASE("a client killed and started again is back within a second and replaces its old connection") {
  Site site(2, {});
  site.run(0.2);
  const ClientId old = site.id_of(0);
  site.add_client(0, Site::client_key(0));
  site.run(0.1);
  CHECK(site.clients[0]->state() == ClientState::connected);
  CHECK(!site.server->info(old));
  CHECK(site.server->clients().size() == 2);
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

TEST_CASE("clients whose clocks differ and drift know the server's clock within two milliseconds on a bad network") {
  // A round trip of 1 ms; there and back unlike; drift of up to 200 ppm between two clocks.
  const NetworkFaults quiet{.latency_s = 0.0005}, bad{.loss = 0.05, .latency_s = 0.0005, .jitter_s = 0.020},
      worse{.loss = 0.05, .latency_s = 0.0005, .jitter_s = 0.040};
  for (const NetworkFaults& faults : {quiet, bad, worse}) {
    CAPTURE(faults.jitter_s);
    Site site(7, faults);
    site.run(3.0);
    double worst_s = 0.0;
    for (int look = 0; look < 100; ++look) {
      site.run(0.1);
      for (std::size_t n = 0; n < site.clients.size(); ++n) {
        REQUIRE(site.clients[n]->clock().valid());
        const double error_s = std::abs(site.clock_error_s(n));
        CHECK(error_s <= site.clients[n]->clock().uncertainty_s() + 0.0002);
        worst_s = std::max(worst_s, error_s);
      }
    }
    MESSAGE("jitter " << 1e3 * faults.jitter_s << " ms: the clock is wrong by " << 1e3 * worst_s << " ms at most");
    CHECK(worst_s < (faults.jitter_s > 0.0 ? 0.002 : 0.0015));
  }
}

TEST_CASE("a clock that is set is noticed by the next ping and known again two seconds later") {
  const NetworkFaults quiet{.latency_s = 0.0005}, bad{.loss = 0.05, .latency_s = 0.0005, .jitter_s = 0.020};
  for (const NetworkFaults& faults : {quiet, bad})
    for (const bool of_server : {false, true}) {
      CAPTURE(faults.jitter_s);
      CAPTURE(of_server);
      Site site(2, faults);
      site.run(5.0);
      (of_server ? *site.server_machine : *site.client_machines[0]).set_clock_forward(0.5);
      CHECK(std::abs(site.clock_error_s(0)) > 0.49);
      site.run(0.5);  // A lost ping is followed by another a tenth of a second later.
      CHECK(std::abs(site.clock_error_s(0)) < 0.025);
      site.run(1.5);
      CHECK(std::abs(site.clock_error_s(0)) < 0.002);
      CHECK(std::abs(site.clock_error_s(1)) < 0.002);
    }
}

TEST_CASE("a client that looks only sixty times a second at what has arrived knows the server's clock no worse") {
  Site site(3, {.latency_s = 0.0005});
  site.run(1.0);
  for (int frame = 0; frame < 300; ++frame) {
    for (std::size_t n = 0; n < site.clients.size(); ++n) site.hung[n] = true;
    site.run(0.0157);
    for (std::size_t n = 0; n < site.clients.size(); ++n) site.hung[n] = false;
    site.run(0.001);
    for (std::size_t n = 0; n < site.clients.size(); ++n) CHECK(std::abs(site.clock_error_s(n)) < 0.0015);
  }
}

TEST_CASE("the estimate of a clock is the middle of what all pings leave") {
  ClockEstimate clock;
  clock.add(10.0, 110.003, 10.020);  // The way back was slow: the offset is between 99.983 and 100.003.
  clock.add(10.1, 110.118, 10.120);  // The way there: between 99.998 and 100.018.
  CHECK(clock.pings() == 2);
  CHECK(clock.offset_s() == doctest::Approx(100.0005).epsilon(1e-6));
  CHECK(clock.uncertainty_s() == doctest::Approx(0.0025 + 0.00001).epsilon(0.01).scale(0.0));
  // What an old ping said counts for less and less: two clocks drift apart.
  for (int k = 1; k <= 10; ++k) clock.add(10.0 + k, 110.0105 + k, 10.020 + k);
  CHECK(clock.uncertainty_s() > 0.0025 + 0.0015);
  // One that cannot be true if the others are: a clock was set.
  clock.add(30.0, 180.001, 30.002);
  CHECK(clock.pings() == 1);
  CHECK(clock.offset_s() == doctest::Approx(150.0).epsilon(1e-6));
  // Nor are times any better that no clock shows.
  clock.add(std::nan(""), 181.0, 31.0);
  clock.add(31.0, 181.0, 30.9);
  CHECK(clock.pings() == 1);
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

TEST_CASE("a goodbye ends the connection at once") {
  Site site(2, {});
  site.run(0.1);
  site.clients[0]->close();
  site.server->disconnect(site.id_of(1), "the drive is over");
  site.run(0.01);
  CHECK(site.count(ServerEvent::Kind::disconnected) == 2);
  REQUIRE(site.client_events[1].size() == 2);
  CHECK(site.client_events[1][1].kind == ClientEvent::Kind::lost);
}

}  // namespace
}  // namespace septet::net
