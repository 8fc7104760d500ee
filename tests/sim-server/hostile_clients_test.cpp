#include <doctest/doctest.h>

#include "engine/core/random.hpp"
#include "tests/sim-server/client_script.hpp"

namespace septet::server {
namespace {

using enum ScriptStep;

bool is_live(ClientScript& rig, std::string_view name) {
  for (const auto& screen : rig.host().screens())
    if (screen.name == name) return screen.live();
  return false;
}

constexpr int here = 0, elsewhere = 1;

}  // namespace

TEST_CASE("a screen that connects twice while the server is busy is there once") {
  for (const int where : {here, elsewhere}) {
    ClientScript rig;
    // All is pending in the server's socket, or arrives while it reads: Hello and a scene message under one connection,
    // then another one is confirmed that takes its place.
    rig.play(script(pump, a, pump, a, end_of_pump, a, 0, pump, a, hello, a, a, scene_hello, a, pump, a, raw, a, 2, 0, 1,
                    pump, a, restart, a, where, pump, a, pump, a, pump, a, pump, a, hello, a, a, pump, a, end_of_pump,
                    a, 0));
    // From another address it was refused while the first one was alive; that one sent unreadable data, and is out.
    for (int turn = 0; turn < 3; ++turn) rig.play(script(end_of_pump, a, 100, pump, a, pump, a, pump, a));
    rig.play(script(hello, a, a, pump, a, end_of_pump, a, 0));
    CHECK(is_live(rig, "a"));
  }
}

TEST_CASE("a hello under the name of another screen does not touch that screen") {
  for (const int attacker : {b, car}) {
    ClientScript rig;
    rig.connect_all();
    // The attacker's Hello waits before the screen's own message.
    rig.play(script(hello, attacker, a, pump, attacker, scene_hello, a, pump, a, end_of_pump, a, 0));
    rig.play(script(end_of_pump, a, 0));
    CHECK(is_live(rig, "a"));
  }
}

TEST_CASE("controls come from the screen that the rig lets drive and from nobody else") {
  ClientScript rig;
  rig.connect_all();
  DriverInput input;
  for (const int client : {b, car, a}) {
    input.accelerator += 0.25;
    rig.play(says(client, control::Controls{input}));
  }
  REQUIRE(rig.controls().size() == 1);
  CHECK(rig.controls()[0].accelerator == 0.75);
}

TEST_CASE("a screen that comes and goes all day fills no memory") {
  ClientScript rig;
  rig.connect_all();
  // Each message of the handshake is a pump of its own.
  const Bytes come_back =
      script(goodbye, a, end_of_pump, a, 100, restart, a, here, pump, a, end_of_pump, a, 1, pump, a, end_of_pump, a, 1,
             pump, a, end_of_pump, a, 1, pump, a, hello, a, a, pump, a, end_of_pump, a, 1);
  for (int i = 0; i < 300; ++i) rig.play(come_back);
  const auto& screen = rig.host().screens().front();
  CHECK(screen.joined > 200);
  CHECK(screen.connected_s.size() == most_moments);
  CHECK(screen.connected_s.front() == 0.0);
  CHECK(screen.left_behind_s.size() <= most_moments);
}

TEST_CASE("whatever clients of the list send in whatever order the host goes on") {
  Random random(20);
  for (int round = 0; round < 300; ++round) {
    Bytes bytes(600);
    // Steps of a script rather than noise, as far as a byte can be one.
    for (std::size_t i = 0; i < bytes.size(); ++i)
      bytes[i] = static_cast<std::byte>(random.next_bits() % (random.uniform() < 0.7 ? 13 : 256));
    ClientScript rig;
    if (round % 2 == 0) rig.connect_all();
    CAPTURE(round);
    rig.play(bytes);
    CHECK(rig.host().screens().size() == 2);
  }
}

}  // namespace septet::server
