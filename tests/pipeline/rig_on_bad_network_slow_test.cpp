#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "tests/engine/replication/sample_world.hpp"
#include "tests/pipeline/simulated_rig.hpp"

namespace septet {
namespace {

struct Presented {
  int frames = 0, skewed = 0, held = 0, wrong = 0;
};

/// Every live screen presents each frame when its own clock asks for it; the frames of one number are compared with
/// each other and with the truth.
Presented present(SimulatedRig& rig, double seconds, const std::set<std::size_t>& without = {}) {
  Presented result;
  std::vector<std::optional<std::int64_t>> last(rig.size());
  std::map<std::int64_t, std::set<Tick>> ticks_of_frame;
  for (int ms = 0; ms < static_cast<int>(seconds * 1000.0); ++ms) {
    rig.advance_1ms();
    for (std::size_t i = 0; i < rig.size(); ++i) {
      const auto due = without.contains(i) ? std::nullopt : rig.frame_due(i);
      if (!due || due == last[i]) continue;
      last[i] = due;
      const auto shown = rig.shown(i);
      if (!shown) {
        ++result.held;
        continue;
      }
      ++result.frames;
      ticks_of_frame[*due].insert(shown->tick);
      if (!shown->on_tick) ++result.held;
      // Every vehicle is where its circle has it at the time that is claimed to be shown.
      const double t = shown->snapshot.simulated_time_s;
      const Participant& p = shown->snapshot.participants.front();
      const double angle = 25.0 / 40.0 * t;
      if (glm::length(p.world_from_vehicle.position_m - Vec3(40.0 * std::sin(angle), -40.0 * std::cos(angle), 0.0)) >
          0.002)
        ++result.wrong;
    }
  }
  for (const auto& [number, ticks] : ticks_of_frame) result.skewed += ticks.size() > 1;
  return result;
}

/// So many frames at least, every one on its tick, on the same tick as the other screens', and true.
void check_flawless(const Presented& seen, int least_frames) {
  CHECK(seen.frames >= least_frames);
  CHECK(seen.skewed == 0);
  CHECK(seen.held == 0);
  CHECK(seen.wrong == 0);
}

/// Every frame that every screen shows begins within 2 ms of the instant that the server means, in true time.
void check_in_true_time(SimulatedRig& rig, double seconds, const std::string& name) {
  constexpr double step_s = 0.00025;  // Adds up to one step to the measurement.
  std::vector<std::optional<std::int64_t>> last(rig.size());
  int frames = 0;
  double earliest_s = 1.0, latest_s = -1.0;
  for (int step = 0; step < static_cast<int>(seconds / step_s); ++step) {
    rig.advance(step_s);
    for (std::size_t i = 0; i < rig.size(); ++i) {
      const auto due = rig.frame_due(i);
      const auto begun = std::exchange(last[i], due);
      if (!begun || due == begun) continue;
      const auto lateness_s = rig.lateness_s(i);
      if (!lateness_s) continue;
      ++frames;
      earliest_s = std::min(earliest_s, *lateness_s);
      latest_s = std::max(latest_s, *lateness_s);
    }
  }
  MESSAGE(name << ": " << 1e3 * earliest_s << " to " << 1e3 * latest_s << " ms late");
  CHECK(frames >= static_cast<int>(7 * 59 * seconds));
  CHECK(earliest_s > -0.002);
  CHECK(latest_s < 0.002);
}

}  // namespace

TEST_CASE("on a good network seven screens show the same tick in every frame") {
  SimulatedRig rig({});
  rig.run_for(1.0);
  check_flawless(present(rig, 3.0), 7 * 179);
}

TEST_CASE(
    "every screen shows what the server means within two milliseconds of true time whatever its clock and its network "
    "do") {
  struct Case {
    std::string name;
    net::NetworkFaults faults;
    double screen_pump_s;
  };
  const Case cases[] = {
      {"good network", {.latency_s = 0.0005}, 0.0},
      {"screens that draw", {.latency_s = 0.0005}, 1.0 / 60.0},
      {"loss and jitter", {.loss = 0.05, .latency_s = 0.0005, .jitter_s = 0.020}, 0.0},
      {"loss and jitter, screens that draw", {.loss = 0.05, .latency_s = 0.0005, .jitter_s = 0.020}, 1.0 / 60.0}};
  for (const Case& c : cases) {
    CAPTURE(c.name);
    SimulatedRig rig({.faults = c.faults, .seed = 5, .vehicles = 5, .screen_pump_s = c.screen_pump_s});
    rig.run_for(3.0);
    check_in_true_time(rig, 3.0, c.name);
    rig.screen(2).machine->set_clock_forward(0.7);
    rig.run_for(3.0);
    check_in_true_time(rig, 1.0, c.name + ", a screen's clock was set");
    rig.server_machine().set_clock_forward(0.7);
    rig.run_for(8.0);  // The simulation takes up the time that it lacks; then the play-out delay forgets it.
    check_in_true_time(rig, 1.0, c.name + ", the server's clock was set");
  }
}

TEST_CASE(
    "loss of five percent and twenty milliseconds of jitter and reordering freeze one frame in a thousand at most and "
    "make none wrong") {
  for (const bool multicast : {true, false}) {
    SimulatedRig rig(
        {.faults = {.loss = 0.05, .latency_s = 0.0005, .jitter_s = 0.020}, .multicast = multicast, .seed = 3});
    rig.run_for(3.0);  // The play-out delay finds its length.
    const Presented seen = present(rig, 6.0);
    MESSAGE("play-out delay " << 1e3 * rig.host().playout_delay_s() << " ms, tick " << rig.host().last_tick_bytes()
                              << " bytes");
    // Four datagrams in a row, a tick's and its neighbours', are lost too seldom for the play-out delay to expect it.
    CHECK(seen.held * 1000 <= seen.frames);
    check_flawless({.frames = seen.frames, .skewed = seen.skewed, .wrong = seen.wrong}, 7 * 355);
  }
}

TEST_CASE("whatever the play-out delay a tick published late by a millisecond skews no frame") {
  // The rig publishes on whole milliseconds, so every tick but each third is late by a part of one.
  for (const double delay_ticks : {2.0, 2.95, 3.02, 3.5}) {
    SimulatedRig rig({.screens = 3,
                      .faults = {.latency_s = 0.0005, .jitter_s = 0.002},
                      .least_playout_delay_s = delay_ticks * rig_tick_s});
    rig.run_for(1.0);
    CAPTURE(delay_ticks);
    check_flawless(present(rig, 1.0), 3 * 59);
  }
}

TEST_CASE("a screen that dies costs the others no frame and is back within a second") {
  SimulatedRig rig({});
  rig.run_for(1.0);
  rig.stop_screen(3);
  check_flawless(present(rig, 2.0, {3}), 6 * 119);
  rig.start_screen(3);
  double back_s = 0.0;
  while (back_s < 2.0 && !(rig.shown(3) && rig.shown(3)->on_tick && rig.screen(3).link->scene_arrived())) {
    rig.run_for(0.01);
    back_s += 0.01;
  }
  MESSAGE("back after " << back_s << " s");
  CHECK(back_s < 1.0);
  rig.run_for(0.3);
  check_flawless(present(rig, 1.0), 7 * 59);
}

TEST_CASE("a hung screen costs the others nothing") {
  SimulatedRig rig({});
  rig.run_for(1.0);
  rig.screen(2).hung = true;
  check_flawless(present(rig, 4.0, {2}), 6 * 239);
  rig.screen(2).hung = false;
  rig.run_for(1.0);
  check_flawless(present(rig, 1.0), 7 * 59);
}

TEST_CASE("screens that do not hear the group get their ticks by unicast and show what the others show") {
  SimulatedRig rig({.screens = 4, .deaf = {1, 2}});
  rig.run_for(1.0);
  check_flawless(present(rig, 3.0), 4 * 179);
}

TEST_CASE("a screen that joins late has a whole motorway within one simulated second") {
  for (const double loss : {0.0, 0.01, 0.05}) {
    SimulatedRig rig({.screens = 2,
                      .faults = {.loss = loss, .latency_s = 0.0003},
                      .vehicles = 20,
                      .world = replication::build_sample_world});
    rig.stop_screen(1);
    rig.run_for(3.0);
    REQUIRE(rig.screen(0).link->scene_arrived());
    const auto before = rig.network().sent_by(rig.lane_address());
    rig.start_screen(1);
    double joined_s = 0.0;
    while (joined_s < 3.0 && !rig.screen(1).link->scene_arrived()) {
      rig.advance_1ms();
      joined_s += 0.001;
    }
    const auto after = rig.network().sent_by(rig.lane_address());
    MESSAGE("loss " << loss << ": complete after " << joined_s << " s and " << after.bytes - before.bytes << " bytes");
    CHECK(joined_s < 1.0);
    CHECK(after.bytes - before.bytes < 10'000'000);
    CHECK(same_content(rig.screen(1).link->scene(), rig.store()));
  }
}

TEST_CASE("screens hold their last tick while the server is gone and return by themselves") {
  SimulatedRig rig({});
  rig.run_for(1.0);
  rig.stop_server();
  rig.run_for(2.5);  // The lane's two seconds begin with the first ping without a pong.
  for (std::size_t i = 0; i < rig.size(); ++i) {
    CHECK(rig.screen(i).link->state() == net::ClientState::lost);
    CHECK_FALSE(rig.screen(i).link->history().empty());
  }
  rig.start_server();
  rig.run_for(2.0);
  for (std::size_t i = 0; i < rig.size(); ++i) {
    CHECK(rig.screen(i).link->state() == net::ClientState::connected);
    CHECK(rig.screen(i).link->scene_arrived());
  }
  check_flawless(present(rig, 1.0), 7 * 59);
}

TEST_CASE("a screen that draws for seconds never takes its server for gone and one whose server is gone does") {
  SimulatedRig rig({.screens = 1});
  rig.run_for(1.0);
  auto& screen = rig.screen(0);
  bool dropped = false;
  for (const double drawing_s : {0.6, 0.6, 1.5, 0.6, 6.0, 0.6, 0.6, 6.0, 1.0, 1.0}) {
    screen.hung = true;
    rig.run_for(drawing_s);
    screen.hung = false;
    CAPTURE(drawing_s);
    for (int i = 0; i < 3; ++i) {
      rig.advance_1ms();
      CHECK_FALSE(screen.link->server_is_gone());
    }
    dropped = dropped || screen.link->state() == net::ClientState::lost;
  }
  CHECK(dropped);  // The server has given it up meanwhile.
  rig.run_for(1.0);
  CHECK(screen.link->state() == net::ClientState::connected);
  rig.stop_server();
  rig.run_for(0.5);
  CHECK_FALSE(screen.link->server_is_gone());
  rig.run_for(1.0);
  CHECK(screen.link->server_is_gone());
  rig.start_server();
  rig.run_for(1.0);
  CHECK_FALSE(screen.link->server_is_gone());
}

TEST_CASE("bytes per tick do not grow with the number of screens") {
  double bytes_per_tick[3] = {};
  const std::size_t counts[3] = {1, 7, 21};
  for (int k = 0; k < 3; ++k) {
    SimulatedRig rig({.screens = counts[k]});
    rig.run_for(1.0);
    const auto before = rig.network().sent_by(rig.tick_address()).bytes;
    rig.run_for(1.0);
    bytes_per_tick[k] = static_cast<double>(rig.network().sent_by(rig.tick_address()).bytes - before) / 120.0;
    MESSAGE(counts[k] << " screens: " << bytes_per_tick[k] << " bytes per tick, repetition included");
  }
  CHECK(bytes_per_tick[1] < 1.05 * bytes_per_tick[0]);
  CHECK(bytes_per_tick[2] < 1.05 * bytes_per_tick[0]);
}

TEST_CASE("random and forged datagrams change nothing") {
  SimulatedRig rig({.screens = 2});
  rig.run_for(1.0);
  auto stranger = rig.network().open({0x0a0000ff, 1});
  Random random(5);
  for (int i = 0; i < 500; ++i) {
    Bytes rubbish(random.below(1400));
    for (auto& byte : rubbish) byte = static_cast<std::byte>(random.below(256));
    stranger->send(rig.group(), rubbish);
    stranger->send({0x0a000001, 4750}, rubbish);
    stranger->flush();
    if (i % 50 == 0) rig.run_for(0.01);
  }
  check_flawless(present(rig, 1.0), 2 * 59);
  const auto& counters = rig.screen(0).link->tick_counters();
  CHECK(counters.malformed + counters.forged + counters.other_session + counters.oversized > 300);
}

}  // namespace septet
