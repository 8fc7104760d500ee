#include "engine/net/handshake.hpp"

#include <doctest/doctest.h>

#include "tests/engine/net/net_fixtures.hpp"

namespace septet::net {
namespace {

const Terms client_terms{1200, 1 << 20, 1 << 20, 1 << 20}, server_terms{9000, 1 << 22, 1 << 21, 1 << 20};
const Address home = client_address(0), elsewhere = client_address(1);

struct Exchange {
  CookieJar jar;
  ClientHandshake client = *ClientHandshake::start(identity_of(2), identity_of(1).public_key(), client_terms);
  Bytes initiation;
  Exchange() {
    REQUIRE(client.accept_cookie(*jar.answer(client.hello(), home, 12.0)));
    initiation = client.initiation();
  }
};

TEST_CASE("both ends derive the same keys and learn each other's terms and identity") {
  Exchange exchange;
  const auto server = ServerHandshake::accept(exchange.initiation, identity_of(1));
  REQUIRE(server.has_value());
  CHECK(server->client() == identity_of(2).public_key());
  CHECK(server->client_terms() == client_terms);
  const auto answer = server->respond(77, session_of(5), server_terms);
  REQUIRE(answer.has_value());
  const auto connected = exchange.client.accept_response(answer->response);
  REQUIRE(connected.has_value());
  CHECK(connected->connection == 77);
  CHECK(connected->session == session_of(5));
  CHECK(connected->server == server_terms);
  CHECK(connected->keys.sending == answer->keys.receiving);
  CHECK(connected->keys.receiving == answer->keys.sending);
  CHECK(connected->keys.sending != connected->keys.receiving);
}

TEST_CASE(
    "a cookie is good only at its address and for a short time and no answer is longer than its "
    "question") {
  Exchange exchange;
  CHECK(exchange.jar.is_good(exchange.initiation, home, 12.0));
  CHECK(exchange.jar.is_good(exchange.initiation, home, 19.9));
  CHECK_FALSE(exchange.jar.is_good(exchange.initiation, home, 20.1));
  CHECK_FALSE(exchange.jar.is_good(exchange.initiation, elsewhere, 12.0));
  CHECK_FALSE(CookieJar().is_good(exchange.initiation, home, 12.0));
  CHECK(exchange.jar.answer(exchange.client.hello(), home, 12.0)->size() <= exchange.client.hello().size());
  const auto server = ServerHandshake::accept(exchange.initiation, identity_of(1));
  CHECK(server->respond(1, session_of(1), server_terms)->response.size() <= exchange.initiation.size());
}

TEST_CASE("an initiation or response with any byte altered opens nothing") {
  Exchange exchange;
  const auto server = ServerHandshake::accept(exchange.initiation, identity_of(1));
  const Bytes response = server->respond(1, session_of(1), server_terms)->response;
  for (std::size_t i = 0; i < exchange.initiation.size(); i += 3) {
    if (i >= 3 && i < 19) continue;  // The cookie, which the jar judges.
    Bytes altered = exchange.initiation;
    altered[i] ^= std::byte{4};
    CHECK_FALSE(ServerHandshake::accept(altered, identity_of(1)).has_value());
  }
  for (std::size_t i = 0; i < response.size(); i += 3) {
    Bytes altered = response;
    altered[i] ^= std::byte{4};
    CHECK_FALSE(exchange.client.accept_response(altered).has_value());
  }
  CHECK(exchange.client.accept_response(response).has_value());
}

TEST_CASE("only the pinned server can open an initiation") {
  Exchange exchange;
  CHECK_FALSE(ServerHandshake::accept(exchange.initiation, identity_of(3)).has_value());
}

TEST_CASE("a pinned key that is no point of the curve starts no handshake") {
  PublicKey zero{};
  CHECK_FALSE(ClientHandshake::start(identity_of(2), zero, client_terms).has_value());
}

}  // namespace
}  // namespace septet::net
