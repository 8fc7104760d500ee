#include "engine/net/connection_report.hpp"

#include <doctest/doctest.h>

#include "tests/engine/net/net_fixtures.hpp"
#include "tests/relative.hpp"

namespace septet::net {
namespace {

TEST_CASE(
    "an operator is told of a connection when it stands and when it is lost and of an obstacle every half minute") {
  Site site(1, {});
  ConnectionReport report(server_address, identity_of(100).public_key(), "ahead-1");
  const auto look = [&](bool welcome = true) { return report.look(*site.clients[0], welcome, site.now_s); };
  CHECK_FALSE(look());
  site.run(0.2);
  CHECK_FALSE(look(false));  // Connected, but not yet accepted as a screen.
  const auto connected = look();
  REQUIRE(connected);
  CHECK(connected->find("connected to the server at 10.0.0.1:4750") != std::string::npos);
  CHECK_FALSE(look());

  site.server.reset();
  std::vector<std::pair<double, std::string>> said;
  const double gone_s = site.now_s;
  for (int look_number = 0; look_number < 800; ++look_number) {
    site.run(0.1, 0.01);
    if (const auto text = look()) said.emplace_back(site.now_s - gone_s, *text);
  }
  REQUIRE(said.size() == 4);
  CHECK(said[0].second.find("is lost (the server is not heard for") != std::string::npos);
  for (std::size_t i = 1; i < said.size(); ++i)
    CHECK(said[i].second.find("no answer from 10.0.0.1:4750") != std::string::npos);
  CHECK(said[2].first - said[1].first == relative(30.0, 0.01));
  CHECK(said[3].first - said[2].first == relative(30.0, 0.01));

  site.start_server(2);
  site.run(2.0);
  const auto again = look();
  REQUIRE(again);
  CHECK(again->starts_with("connected"));
}

TEST_CASE("each obstacle names what to do about it") {
  Site site(0, {});
  site.add_client(0, 200);
  ConnectionReport report(server_address, identity_of(200).public_key(), "left-2");
  site.run(1.0);
  const auto unknown = report.look(*site.clients[0], false, site.now_s);
  REQUIRE(unknown);
  CHECK(unknown->find("allowed-clients there needs the line: " + to_text(identity_of(200).public_key()) + " left-2") !=
        std::string::npos);
}

}  // namespace
}  // namespace septet::net
