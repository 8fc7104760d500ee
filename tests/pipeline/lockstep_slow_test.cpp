#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "engine/scene/content_hash.hpp"
#include "tests/pipeline/rig_service.hpp"

namespace septet {
namespace {

constexpr std::uint64_t draw_every_ticks = 8;
constexpr double silence_s = 1.0;  ///< Less than the lane's own, after which a silent screen is disconnected.

class Circles final : public server::TickSource {
 public:
  Expected<std::shared_ptr<const TakenSnapshot>> next(const std::optional<DriverInput>&) override {
    return std::make_shared<const TakenSnapshot>(circling_vehicles(++tick_, 20));
  }
  logging::DriveEnd end() const override { return logging::DriveEnd::failed; }
  double tick_rate_hz() const override { return 120.0; }

 private:
  Tick tick_ = 0;
};

/// Screens on a simulated clock that acknowledge like the product's: each new tick, once they hold the scene.
class LockstepRig {
 public:
  explicit LockstepRig(std::size_t screens, net::NetworkFaults faults = {.latency_s = 0.0003},
                       std::set<std::size_t> watchers = {})
      : rig({.screens = screens, .faults = faults, .watching = watchers, .real_time = false}),
        watching(std::move(watchers)) {
    rig.run_for(2.0);  // So long that the server knows how often each screen is heard.
  }

  server::ServeResult serve(double seconds, const std::function<void()>& each_ms,
                            std::unique_ptr<server::Attendant> more = nullptr) {
    Circles circles;
    RigClock clock(rig, [&] {
      each_ms();
      for (std::size_t i = 0; i < rig.size(); ++i) answer(i);
    });
    auto attendants = one_attendant(std::make_unique<Listener>(messages));
    if (more) attendants.push_back(std::move(more));
    const auto served = server::serve(circles, rig.host(),
                                      {.lockstep = true,
                                       .draw_every_ticks = draw_every_ticks,
                                       .ticks = static_cast<std::uint64_t>(120.0 * seconds),
                                       .longest_silence_s = silence_s},
                                      attendants, clock);
    REQUIRE_FALSE(served.error.has_value());
    CHECK(served.end == logging::DriveEnd::time_over);
    return served;
  }

  SimulatedRig rig;
  std::set<std::size_t> watching;  ///< Clients that are told ticks, and show nothing.
  std::map<std::size_t, std::vector<Tick>> shown;
  std::map<std::size_t, bool> is_drawing;  ///< It takes long.
  std::vector<std::string> messages;
  std::function<void(std::size_t, Tick)> looks = [](std::size_t, Tick) {};  ///< At a screen that shows a tick.

 private:
  void answer(std::size_t i) {
    auto& screen = rig.screen(i);
    if (!screen.link || screen.hung || is_drawing[i]) return;
    if (screen.link->finished()) return screen.link->report({});
    if (!screen.link->scene_arrived() || screen.link->history().empty()) return;
    if (watching.contains(i)) {
      for (const frame::HistoryTick& tick : screen.link->history().ticks())
        if (shown[i].empty() || tick.snapshot.tick > shown[i].back()) shown[i].push_back(tick.snapshot.tick);
      return;
    }
    const Tick tick = screen.link->history().newest().snapshot.tick;
    if (!shown[i].empty() && shown[i].back() >= tick) return;
    if (!screen.link->has_scene_of(screen.link->history().newest())) return;
    screen.link->show_scene(tick);
    looks(i, tick);
    shown[i].push_back(tick);
    screen.link->send(control::Presented{tick, 1.0f}, net::Reliability::reliable);
  }
};

/// An editor that changes the world once a tick, as soon as it may: each batch makes a node with content, moves the one
/// before and removes an older one.
class Builder final : public server::Attendant {
 public:
  /// `worlds`: hashes of the store, by the ticks that show it first.
  Builder(SimulatedRig& rig, std::map<Tick, std::uint64_t>& worlds) : rig_(rig), worlds_(worlds) {}
  void before_tick(const server::Moment& moment) override {
    if (moment.is_being_drawn || !moment.newest) return;
    const Tick from = moment.newest->snapshot().tick + 1;
    if (worlds_.contains(from)) return;
    const scene::NodeId made = first_ + batches_++;
    std::vector<scene::Command> batch;
    batch.emplace_back(scene::NodeCreate{made, scene::NodeType::object});
    batch.emplace_back(scene::NodeNameSet{made, std::to_string(made)});
    batch.emplace_back(scene::TagGroupSet{made, 0, "draw"});
    batch.emplace_back(scene::TagSet{made, 0, 0, {"to_m", 300.0}});
    if (batches_ > 1) batch.emplace_back(scene::TransformSet{made - 1, {{1.0, 2.0, 3.0}}});
    if (batches_ > 2) batch.emplace_back(scene::NodeDestroy{made - 2});
    for (const scene::Command& command : batch) rig_.change(command, from);
    worlds_[from] = scene::content_hash(rig_.store());
  }

 private:
  static constexpr scene::NodeId first_ = 1000;
  SimulatedRig& rig_;
  std::map<Tick, std::uint64_t>& worlds_;
  scene::NodeId batches_ = 0;
};

}  // namespace

TEST_CASE("in lockstep a world that changes at every tick is shown whole by screens that lose a datagram in twenty") {
  LockstepRig lockstep(3, {.loss = 0.05, .latency_s = 0.002});
  std::map<Tick, std::uint64_t> worlds;
  int compared = 0, different = 0;
  lockstep.looks = [&](std::size_t i, Tick tick) {
    ++compared;
    different += scene::content_hash(lockstep.rig.screen(i).link->scene()) != worlds.at(tick);
  };
  lockstep.serve(
      2.0, [] {}, std::make_unique<Builder>(lockstep.rig, worlds));
  CHECK(compared == 3 * 240 / draw_every_ticks);
  CHECK(different == 0);
}

TEST_CASE(
    "in lockstep a screen that comes up in a world that changes at every tick shows none with what a later one has") {
  LockstepRig lockstep(3, {.loss = 0.05, .latency_s = 0.002});
  std::map<Tick, std::uint64_t> worlds;
  int first_pictures = 0, different = 0;
  bool is_first = false;
  lockstep.looks = [&](std::size_t i, Tick tick) {
    different += scene::content_hash(lockstep.rig.screen(i).link->scene()) != worlds.at(tick);
    if (i == 1 && std::exchange(is_first, false)) ++first_pictures;
  };
  lockstep.serve(
      20.0,
      [&] {
        // The one before has shown its first picture, and some more.
        if (lockstep.shown[1].size() < 3) return;
        is_first = true;
        lockstep.shown[1].clear();
        lockstep.rig.stop_screen(1);
        lockstep.rig.start_screen(1);
      },
      std::make_unique<Builder>(lockstep.rig, worlds));
  CHECK(first_pictures >= 3);
  CHECK(different == 0);
}

TEST_CASE("in lockstep all screens show every drawn tick") {
  LockstepRig lockstep(3);
  lockstep.serve(2.0, [] {});
  for (std::size_t i = 0; i < 3; ++i) {
    REQUIRE(lockstep.shown[i].size() == 240 / draw_every_ticks);
    for (std::size_t n = 0; n < lockstep.shown[i].size(); ++n)
      CHECK(lockstep.shown[i][n] == draw_every_ticks * (n + 1));
  }
}

TEST_CASE(
    "in lockstep who watches is told every tick, the last one before a pause too, and screens draw no more for it") {
  LockstepRig lockstep(3, {.latency_s = 0.0003}, {2});
  const auto served = lockstep.serve(2.0 + 3.0 / 120.0, [] {});
  REQUIRE(lockstep.shown[0].size() == 240 / draw_every_ticks);
  CHECK(lockstep.shown[0] == lockstep.shown[1]);
  lockstep.rig.run_for(0.1);
  for (const frame::HistoryTick& tick : lockstep.rig.screen(2).link->history().ticks())
    if (tick.snapshot.tick > lockstep.shown[2].back()) lockstep.shown[2].push_back(tick.snapshot.tick);
  REQUIRE(lockstep.shown[2].size() == served.ticks);
  for (std::size_t n = 0; n < served.ticks; ++n) CHECK(lockstep.shown[2][n] == n + 1);
}

TEST_CASE("in lockstep a screen that comes up is waited for and misses no tick after it has connected") {
  LockstepRig lockstep(3);
  std::optional<double> killed_s;
  bool started = false;
  Tick newest_at_start = 0;
  lockstep.serve(3.0, [&] {
    const auto& others = lockstep.shown[0];
    if (!killed_s && others.size() == 10) {
      killed_s = lockstep.rig.now_s();
      lockstep.rig.stop_screen(1);
      lockstep.shown[1].clear();
    }
    // It comes back while the others wait for the killed one's report.
    if (killed_s && !started && lockstep.rig.now_s() > *killed_s + 0.5 * silence_s) {
      started = true;
      newest_at_start = others.back();
      lockstep.rig.start_screen(1);
    }
  });
  REQUIRE(started);
  CHECK(newest_at_start == 11 * draw_every_ticks);
  CHECK(lockstep.shown[0].size() == 360 / draw_every_ticks);
  REQUIRE_FALSE(lockstep.shown[1].empty());
  CHECK(lockstep.shown[1].front() == newest_at_start + draw_every_ticks);
}

TEST_CASE("in lockstep a screen that comes up and is silent until the next tick can read that tick") {
  LockstepRig lockstep(3);
  std::optional<double> started_s, silent_from_s;
  const auto served = lockstep.serve(2.0, [&] {
    const double now_s = lockstep.rig.now_s();
    if (!started_s && lockstep.shown[0].size() == 10) {
      started_s = now_s;
      lockstep.rig.start_screen(1);
      lockstep.shown[1].clear();
    }
    // Another one draws so long that the new one, which has the scene, is silent for longer than a baseline waits.
    if (started_s && !silent_from_s && lockstep.rig.screen(1).link->scene_arrived()) silent_from_s = now_s;
    lockstep.is_drawing[2] = started_s && (!silent_from_s || now_s < *silent_from_s + 0.8);
    lockstep.rig.screen(1).hung = silent_from_s && now_s > *silent_from_s + 0.05 && now_s < *silent_from_s + 0.9;
  });
  REQUIRE(silent_from_s);
  CHECK(served.wall_s < 20.0);  // A minute where it cannot read the tick.
  REQUIRE_FALSE(lockstep.shown[1].empty());
  CHECK(lockstep.shown[1].back() == 240);
}

TEST_CASE("in lockstep a screen that hangs is waited for once and shows again what comes after") {
  LockstepRig lockstep(3);
  const auto served = lockstep.serve(
      4.0, [&] { lockstep.rig.screen(2).hung = lockstep.shown[0].size() >= 10 && lockstep.shown[0].size() < 30; });
  CHECK(served.wall_s > silence_s);
  CHECK(served.wall_s < 2.0 * silence_s);
  CHECK(std::ranges::count_if(lockstep.messages, [](const std::string& text) {
          return text.find("go on without it") != std::string::npos;
        }) == 1);
  CHECK(lockstep.shown[0].size() == 480 / draw_every_ticks);
  CHECK(lockstep.shown[2].size() >= 10 + 25);
  CHECK(lockstep.shown[2].back() == 480);
}

TEST_CASE("in lockstep the first frame of a screen is waited for as long as its start") {
  LockstepRig lockstep(2);
  std::optional<double> begun_s;
  lockstep.serve(1.0, [&] {
    if (!begun_s && !lockstep.shown[0].empty()) begun_s = lockstep.rig.now_s();
    lockstep.rig.screen(1).hung = !begun_s || lockstep.rig.now_s() < *begun_s + 1.5 * silence_s;
  });
  CHECK(std::ranges::none_of(
      lockstep.messages, [](const std::string& text) { return text.find("go on without it") != std::string::npos; }));
  CHECK(lockstep.shown[1] == lockstep.shown[0]);
}

TEST_CASE("in lockstep a screen that is heard is waited for however long it takes over a picture") {
  LockstepRig lockstep(2);
  std::optional<double> begun_s;
  lockstep.serve(1.0, [&] {
    if (!begun_s && lockstep.shown[0].size() == 5) begun_s = lockstep.rig.now_s();
    lockstep.is_drawing[1] = begun_s && lockstep.rig.now_s() < *begun_s + 20.0 * silence_s;
  });
  CHECK(std::ranges::none_of(
      lockstep.messages, [](const std::string& text) { return text.find("go on without it") != std::string::npos; }));
  CHECK(lockstep.shown[1] == lockstep.shown[0]);
}

}  // namespace septet
