#include <set>

#include <doctest/doctest.h>

#include "sim-server/page/request_checks.hpp"

namespace septet::page {

TEST_CASE("only this machine's own names and those of a proxy are hosts, as a whole and on any port") {
  const std::vector<std::string> proxy{"sim.school.example"};
  for (const char* host : {"localhost", "LocalHost:8080", "127.0.0.1", "127.0.0.1:1", "[::1]", "[::1]:65535",
                           "sim.school.example", "SIM.school.example:443"})
    CHECK_MESSAGE(is_allowed_host(host, proxy), host);
  for (const char* host : {"",
                           ":80",
                           "127.0.0.1.evil.example",
                           "127.evil.example",
                           "localhost.evil.example",
                           "evil.example",
                           "localhost:",
                           "localhost:80a",
                           "localhost:123456",
                           "localhost:80:80",
                           "[::1",
                           "[::1]80",
                           "[::1].evil",
                           "::1",
                           "0.0.0.0",
                           "127.0.0.2",
                           "localhost ",
                           " localhost",
                           "x@localhost",
                           "localhost/",
                           "school.example"})
    CHECK_MESSAGE(!is_allowed_host(host, proxy), host);
  CHECK(!is_allowed_host("sim.school.example", {}));
  CHECK(!is_allowed_host("", std::vector<std::string>{""}));
}

TEST_CASE("an origin is the page's own only with the same host and port") {
  CHECK(is_own_origin("http://127.0.0.1:8080", "127.0.0.1:8080"));
  CHECK(is_own_origin("https://sim.school.example", "sim.school.example"));
  for (const char* origin :
       {"http://127.0.0.1:8081", "http://localhost:8080", "http://evil.example", "null", "", "127.0.0.1:8080",
        "http://127.0.0.1:8080.evil.example", "file://127.0.0.1:8080", "http://127.0.0.1"})
    CHECK_MESSAGE(!is_own_origin(origin, "127.0.0.1:8080"), origin);
}

TEST_CASE("a token is one of the subprotocols, whole") {
  const std::string token = random_token();
  CHECK(holds_token("septet, " + token, token));
  CHECK(holds_token(token, token));
  CHECK(!holds_token("septet", token));
  CHECK(!holds_token("", token));
  CHECK(!holds_token("", ""));
  CHECK(!holds_token(",", ""));
  CHECK(!holds_token(token.substr(1), token));
  CHECK(!holds_token(token + token, token));
  CHECK(!holds_token(token + "0", token));
}

TEST_CASE("no two of a thousand tokens are the same, each of 32 hexadecimal digits") {
  std::set<std::string> tokens;
  for (int i = 0; i < 1000; ++i) {
    tokens.insert(random_token());
    CHECK(tokens.begin()->size() == 32);
    CHECK(tokens.begin()->find_first_not_of("0123456789abcdef") == std::string::npos);
  }
  CHECK(tokens.size() == 1000);
}

}  // namespace septet::page
