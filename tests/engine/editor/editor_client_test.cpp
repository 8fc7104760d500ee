#include "engine/editor/editor_client.hpp"

#include <doctest/doctest.h>

#include "engine/net/keys.hpp"
#include "engine/net/udp_socket.hpp"
#include "tests/temporary_folder.hpp"

namespace septet::editor {

TEST_CASE("an editor whose folder lacks its key is told so, and one that nobody answers gives up by its clock") {
  const TemporaryFolder folder;
  double now_s = 0.0;
  const Clock clock = [&] { return now_s += 1.0; };
  const auto without = EditorClient::connect(folder.path(), clock);
  REQUIRE_FALSE(without.has_value());
  CHECK(without.error().what == "there is no key");

  const auto silent = net::UdpSocket::open({{net::loopback_ip, 0}});
  REQUIRE(silent.has_value());
  const auto identity = net::load_or_create_identity(folder / "lab.key");
  REQUIRE(identity.has_value());
  const auto unanswered =
      EditorClient::connect({silent->local_address(), identity->public_key(), *identity, "lab"}, clock, 5.0);
  REQUIRE_FALSE(unanswered.has_value());
  CHECK(unanswered.error().what == "the server does not let this editor in");
  CHECK(now_s < 20.0);
}

}  // namespace septet::editor
