#include <chrono>
#include <future>
#include <string>
#include <variant>

#include <doctest/doctest.h>

#include "engine/control/control_message.hpp"
#include "engine/document/text_file.hpp"
#include "engine/net/keys.hpp"
#include "engine/net/secure_server.hpp"
#include "engine/net/udp_socket.hpp"
#include "program/clock.hpp"
#include "sim-client/screen/screen_session.hpp"
#include "tests/shipped_files.hpp"
#include "tests/temporary_folder.hpp"

namespace septet::screen {

TEST_CASE("a screen that fails says goodbye: the next one with its key is let in at once") {
  const TemporaryFolder keys;
  const auto screen = net::load_or_create_identity(keys / "lone.key"), own = net::load_or_create_identity(keys / "own");
  REQUIRE((screen && own));
  REQUIRE(document::write_text_files(keys.path(), {{"server.public", net::to_text(own->public_key()) + '\n'}}));
  auto socket = net::UdpSocket::open({{net::loopback_ip, 0}});
  REQUIRE(socket.has_value());
  net::SecureServer server(*socket, {*own, {}, {{screen->public_key(), "lone"}}, {}});

  const ScreenOptions options{
      .name = "lone", .server = socket->local_address(), .keys = keys.path(), .pictures = {}, .monitor = {}};
  auto ran = std::async(std::launch::async, [&] { return run_screen(options); });
  double now_s = program::monotonic_s();
  std::string left;
  const auto serve = [&] {
    for (const net::ServerEvent& event : server.pump(now_s)) {
      if (event.kind == net::ServerEvent::Kind::disconnected) left = event.reason;
      if (event.kind != net::ServerEvent::Kind::message) continue;
      const auto message = control::decode_control(event.bytes);
      if (!message || !std::holds_alternative<control::Hello>(*message)) continue;
      // A rig without this screen: it fails as it does without a display to open.
      server.send(event.client,
                  net::share(control::encode_control(control::Welcome{shipped_text("rigs/desktop.toml")})),
                  net::Reliability::reliable);
    }
  };
  while (ran.wait_for(std::chrono::milliseconds(1)) != std::future_status::ready) {
    now_s = program::monotonic_s();
    serve();
  }
  const auto failed = ran.get();
  REQUIRE_FALSE(failed.has_value());
  CHECK(failed.error().what == "the rig has no such screen");
  serve();  // No time has passed for the server: what it learns now, the screen has told it.
  CHECK(server.clients().empty());
  CHECK(left.find("not heard") == std::string::npos);
  CHECK_FALSE(left.empty());
}

}  // namespace septet::screen
