#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "tests/engine/net/net_fixtures.hpp"

namespace septet::net {
namespace {

TEST_CASE("an allowed client connects and both sides know each other") {
  Site site(2, {});
  site.run(0.1);
  REQUIRE(site.count(ServerEvent::Kind::connected) == 2);
  CHECK(site.clients[0]->state() == ClientState::connected);
  CHECK(site.clients[0]->session() == session_of(1));
  CHECK(site.server->info(site.id_of(1))->name == "client-1");
  CHECK(site.server->counters().forged + site.server->counters().malformed == 0);
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
  // Endless but rare attempts: one every five seconds at most, and a report to the operator every half minute.
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
  CHECK(site.clients[0]->obstacle() == Obstacle::none);  // No long attempt yet.
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
  // Vice versa: the server is of another version.
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
  // Power loss of its machine: silence.
  site.hung[0] = true;
  site.run(3.0);
  CHECK(site.clients[1]->state() == ClientState::connected);
  CHECK(site.clients[1]->obstacle() == Obstacle::none);
}

TEST_CASE("a client that is heard once a second stays, however often another one with its key knocks") {
  // Drawing time of its program for each picture; the first pictures take longer.
  for (const double silence_s : {0.3, 0.6, 1.0, 1.5, 1.9}) {
    CAPTURE(silence_s);
    Site site(1, {});
    site.run(0.05);
    const ClientId first = site.id_of(0);
    site.hung[0] = true;
    site.add_client(1, Site::client_key(0));
    for (double at_s = 0.0; at_s < 30.0; at_s += silence_s) {
      site.hung[0] = true;
      site.run(silence_s);
      site.hung[0] = false;
      site.run(0.02);
      CHECK(site.server->clients() == std::vector{first});
      CHECK(site.clients[1]->obstacle() == Obstacle::key_in_use);
    }
    CHECK(site.count(ServerEvent::Kind::connected) == 1);
    // A client that is gone for good makes room within the time-out and the newcomer's next knock.
    site.hung[0] = true;
    site.run(7.5);
    CHECK(site.clients[1]->state() == ClientState::connected);
  }
}

TEST_CASE("a client that was slow once is not waited for long when it draws fast again") {
  Site site(1, {});
  site.run(1.0);
  site.hung[0] = true;
  site.run(1.5);
  site.hung[0] = false;
  site.run(30.0);
  site.hung[0] = true;
  site.add_client(1, Site::client_key(0));
  site.run(1.5);
  CHECK(site.clients[1]->state() == ClientState::connected);
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
  // For a while the clients send and the server does not read.
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
