/// The world waits for its driver: server loop, screens and network on simulated clocks.

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "sim-client/screen/pause_request.hpp"
#include "tests/pipeline/rig_service.hpp"

namespace septet {
namespace {

/// Circles whose driver is ready with the first controls from a screen.
class DrivenCircles final : public server::TickSource {
 public:
  std::shared_ptr<const TakenSnapshot> first() const override {
    return std::make_shared<const TakenSnapshot>(circling_vehicles(0, 20));
  }
  bool driver_is_ready(const std::optional<DriverInput>& controls, double) override { return controls.has_value(); }
  Expected<std::shared_ptr<const TakenSnapshot>> next(const std::optional<DriverInput>&) override {
    return std::make_shared<const TakenSnapshot>(circling_vehicles(++tick, 20));
  }
  void stand_still() override { ++rests; }
  double tick_rate_hz() const override { return 120.0; }
  logging::DriveEnd end() const override { return logging::DriveEnd::failed; }

  Tick tick = 0;
  int rests = 0;  ///< Number of commands to rest to the driver's seat.
};

/// An operator who pauses, and may end the drive.
class Pausing final : public server::Attendant {
 public:
  Pausing(const bool& is_paused, std::function<void(const server::Moment&)> look)
      : is_paused_(is_paused), look_(std::move(look)) {}
  void before_tick(const server::Moment& moment) override { look_(moment); }
  server::Wishes wishes() override {
    server::Wishes wishes{.stands_still = is_paused_};
    if (asks_before_end && ++asked_ > *asks_before_end) wishes.end = logging::DriveEnd::by_operator;
    return wishes;
  }

  std::optional<int> asks_before_end;

 private:
  const bool& is_paused_;
  std::function<void(const server::Moment&)> look_;
  int asked_ = 0;
};

class StillClock final : public server::ServeClock {
 public:
  double now_s() const override { return 0.0; }
  void wait(double) override {}
};

}  // namespace

TEST_CASE("the world stands still and says so until the driver takes the controls") {
  SimulatedRig rig({.screens = 2, .real_time = false});
  rig.run_for(0.5);
  DrivenCircles circles;
  std::vector<std::string> messages;
  double ready_s = 0.0, joined_s = 0.0;
  RigClock clock(rig, [&] {
    auto& screen = rig.screen(0);
    if (screen.link->finished()) {
      report_all(rig);
    } else if (ready_s == 0.0 && rig.now_s() < 4.0) {
      CHECK(circles.tick == 0);
      if (rig.now_s() > 1.0) {
        CHECK(screen.link->notice().text == "Press any key to start");
        REQUIRE(rig.shown(0));
        CHECK(rig.shown(0)->tick == 0);
      }
      // A screen that joins while the world waits sees it too.
      if (joined_s == 0.0 && rig.now_s() > 2.0) {
        rig.stop_screen(1);
        rig.start_screen(1);
        joined_s = rig.now_s();
      }
    } else if (ready_s == 0.0) {
      REQUIRE(rig.shown(1));
      CHECK(rig.shown(1)->tick == 0);
      CHECK(rig.screen(1).link->notice().text == "Press any key to start");
      ready_s = rig.now_s();
      screen.link->send(control::Controls{}, net::Reliability::unreliable);
    }
  });
  const auto served = server::serve(circles, rig.host(), {.ticks = 240, .wait_for_driver = "Press any key to start"},
                                    one_attendant(std::make_unique<Listener>(messages)), clock);
  CHECK(served.end == logging::DriveEnd::time_over);
  CHECK(served.ticks == 240);
  CHECK(served.late_ticks == 0);
  CHECK(served.wall_s < 2.5);  // Of the simulated clock: waiting is not driving.
  CHECK(joined_s > 0.0);
  CHECK(rig.now_s() > ready_s + 1.9);
  CHECK(rig.screen(0).link->notice().text.empty());
  CHECK(rig.shown(0)->tick >= 236);  // Less the play-out delay.
  CHECK(std::ranges::count_if(messages, [](const std::string& text) {
          return text.starts_with("the driver took the controls after");
        }) == 1);
}

TEST_CASE("a screen that was silent for too long while the world waits shows it again, and its keys begin the drive") {
  SimulatedRig rig({.screens = 1, .real_time = false});
  rig.run_for(0.5);
  DrivenCircles circles;
  double ready_s = 0.0;
  RigClock clock(rig, [&] {
    auto& screen = rig.screen(0);
    // It compiles its shaders for longer than the server waits for a reply.
    screen.hung = rig.now_s() > 1.0 && rig.now_s() < 9.0;
    if (screen.link->finished()) screen.link->report({});
    if (rig.now_s() < 12.0 || ready_s > 0.0) return;
    REQUIRE(screen.link->welcomes() == 2);
    REQUIRE(rig.shown(0));
    CHECK(rig.shown(0)->tick == 0);
    CHECK(screen.link->notice().text == "Press any key to start\nA first lesson");
    ready_s = rig.now_s();
    screen.link->send(control::Controls{}, net::Reliability::unreliable);
  });
  rig.host().give_notice({"", true});
  const auto served =
      server::serve(circles, rig.host(),
                    {.ticks = 120, .wait_for_driver = "Press any key to start", .about = "A first lesson"}, {}, clock);
  CHECK(served.end == logging::DriveEnd::time_over);
  CHECK_FALSE(rig.screen(0).link->notice().keys);  // A pressed key shows that its holder knows the keys.
  CHECK(ready_s > 0.0);
  CHECK(rig.shown(0)->tick >= 116);
}

TEST_CASE(
    "a drive that the operator pauses stands still on all screens, also on one that comes then, and goes on where it "
    "was") {
  SimulatedRig rig({.screens = 2, .real_time = false});
  rig.run_for(0.5);
  DrivenCircles circles;
  Tick stood_at = 0;
  bool is_paused = false, has_joined = false;
  std::set<std::string> doings;
  RigClock clock(rig, [&] {
    if (rig.screen(0).link->finished()) report_all(rig);
  });
  const auto look = [&](const server::Moment& moment) {
    doings.insert(std::string(moment.doing));
    if (stood_at == 0 && moment.newest && moment.newest->snapshot().tick == 120) {
      stood_at = 120;
      is_paused = true;
    }
    if (!is_paused) return;
    CHECK(circles.tick == 120);
    if (!has_joined && rig.now_s() > 4.0) {
      CHECK(rig.screen(0).link->notice().text == "Paused by the operator");
      REQUIRE(rig.shown(0));
      CHECK(rig.shown(0)->tick >= 116);
      rig.stop_screen(1);
      rig.start_screen(1);
      has_joined = true;
    }
    if (rig.now_s() < 8.0) return;
    CHECK(rig.screen(1).link->notice().text == "Paused by the operator");
    is_paused = false;
  };
  const auto served = server::serve(circles, rig.host(), {.ticks = 240},
                                    one_attendant(std::make_unique<Pausing>(is_paused, look)), clock);
  CHECK(served.end == logging::DriveEnd::time_over);
  CHECK(served.ticks == 240);
  CHECK(served.wall_s < 2.5);  // Of the simulated clock: standing still is not driving.
  CHECK(served.late_ticks <= 1);
  CHECK(circles.rests >= 1);
  CHECK(doings.contains("paused"));
  CHECK(rig.now_s() > 8.9);
  CHECK(rig.screen(0).link->notice().text.empty());
  for (std::size_t i = 0; i < rig.size(); ++i) CHECK(rig.shown(i)->tick >= 236);
}

TEST_CASE("a driver who presses Escape pauses the drive and goes on by it, and before it has begun leaves by it") {
  SimulatedRig rig({.screens = 1, .real_time = false});
  rig.run_for(0.5);
  DrivenCircles circles;
  screen::PauseRequest pause;
  int presses = 0;
  double stood_s = 0.0;
  RigClock clock(rig, [&] {
    auto& link = *rig.screen(0).link;
    if (link.finished()) link.report({});
    if ((presses == 0 && circles.tick == 60) || (presses == 1 && stood_s > 3.0)) {
      pause.toggle(link);
      ++presses;
    }
    pause.tell(link);
    if (!link.notice().paused || presses == 2) return;
    stood_s += 0.001;
    CHECK(link.notice().text.starts_with("Paused. Escape: go on."));
    CHECK(circles.tick < 75);
  });
  const auto served = server::serve(circles, rig.host(), {.ticks = 120}, {}, clock);
  CHECK(served.end == logging::DriveEnd::time_over);
  CHECK(served.ticks == 120);
  CHECK(presses == 2);
  CHECK(circles.rests >= 1);

  SimulatedRig waiting({.screens = 1, .real_time = false});
  waiting.run_for(0.5);
  DrivenCircles not_begun;
  screen::PauseRequest leaves;
  leaves.toggle(*waiting.screen(0).link);
  RigClock other(waiting, [&] {
    leaves.tell(*waiting.screen(0).link);
    if (waiting.screen(0).link->finished()) report_all(waiting);
  });
  const auto left = server::serve(not_begun, waiting.host(), {.wait_for_driver = "Press any key to start"}, {}, other);
  CHECK(left.end == logging::DriveEnd::escape);
  CHECK(left.ticks == 0);
}

TEST_CASE("a drive that has come to its end says so and what to press, keeps its end, and begins again by R") {
  for (const auto how : {control::Quit::How::restart, control::Quit::How::escape}) {
    SimulatedRig rig({.screens = 1, .real_time = false});
    rig.run_for(0.5);
    DrivenCircles circles;
    double read_s = 0.0;
    RigClock clock(rig, [&] {
      auto& link = *rig.screen(0).link;
      if (link.finished()) link.report({});
      if (circles.tick < 60 || link.notice().text.empty()) return;
      CHECK(link.notice().text == "The lesson is over.");
      CHECK(link.notice().paused);  // So that the screen asks for R and Enter.
      CHECK(circles.tick == 60);
      if ((read_s += 0.001) > 3.0 && read_s < 3.0015) link.send(control::Quit{how}, net::Reliability::reliable);
    });
    const auto served = server::serve(
        circles, rig.host(), {.ticks = 60, .words_at_end = [](logging::DriveEnd) { return "The lesson is over."; }}, {},
        clock);
    CHECK(served.end == logging::DriveEnd::time_over);
    CHECK(served.begins_again == (how == control::Quit::How::restart));
    CHECK(served.wall_s < 1.0);  // Reading is not driving.
    CHECK(read_s > 3.0);
    CHECK(read_s < 5.0);
    CHECK(circles.rests >= 1);
  }
}

TEST_CASE("who presses Escape at a drive's end leaves it at once, also one who had paused it before") {
  for (const bool paused_before : {false, true}) {
    CAPTURE(paused_before);
    SimulatedRig rig({.screens = 1, .real_time = false});
    rig.run_for(0.5);
    DrivenCircles circles;
    double read_s = 0.0, stood_s = 0.0;
    RigClock clock(rig, [&] {
      auto& link = *rig.screen(0).link;
      if (link.finished()) link.report({});
      const auto pause = [&](bool wanted) { link.send(control::Pause{wanted}, net::Reliability::reliable); };
      if (paused_before && circles.tick == 20) {
        stood_s += 0.001;
        if (stood_s > 0.0005 && stood_s < 0.0015) pause(true);
        if (stood_s > 1.0 && stood_s < 1.0015) pause(false);
      }
      if (circles.tick < 60 || link.notice().text.empty()) return;
      if ((read_s += 0.001) > 3.0 && read_s < 3.0015) pause(false);
    });
    const auto served = server::serve(
        circles, rig.host(), {.ticks = 60, .words_at_end = [](logging::DriveEnd) { return "The lesson is over."; }}, {},
        clock);
    CHECK(served.end == logging::DriveEnd::time_over);
    CHECK_FALSE(served.begins_again);
    CHECK(read_s > 3.0);
    CHECK(read_s < 5.0);
  }
}

TEST_CASE("the words at a drive's end are read for a minute at most, and not at all where the operator ended it") {
  for (const bool by_operator : {false, true}) {
    SimulatedRig rig({.screens = 1, .real_time = false});
    rig.run_for(0.5);
    DrivenCircles circles;
    const bool is_paused = false;
    const double begun_s = rig.now_s();
    RigClock clock(rig, [&] {
      if (rig.screen(0).link->finished()) report_all(rig);
    });
    auto operating = std::make_unique<Pausing>(is_paused, [](const server::Moment&) {});
    if (by_operator) operating->asks_before_end = 50;
    const auto served = server::serve(
        circles, rig.host(), {.ticks = 120, .words_at_end = [](logging::DriveEnd) { return "The drive is over."; }},
        one_attendant(std::move(operating)), clock);
    CHECK(served.end == (by_operator ? logging::DriveEnd::by_operator : logging::DriveEnd::time_over));
    CHECK_FALSE(served.begins_again);
    CHECK((rig.now_s() - begun_s > 60.0) != by_operator);
    CHECK(rig.now_s() - begun_s < 63.0);
  }
}

TEST_CASE("a paused drive can be ended") {
  DrivenCircles circles;
  bool is_paused = false;
  auto operating = std::make_unique<Pausing>(is_paused, [&](const server::Moment&) { is_paused = circles.tick >= 10; });
  operating->asks_before_end = 50;
  StillClock clock;
  const auto served = server::run_headless(circles, 0, one_attendant(std::move(operating)), clock);
  CHECK(served.end == logging::DriveEnd::by_operator);
  CHECK(served.ticks == 10);
  CHECK(circles.rests >= 1);
}

TEST_CASE("a drive that waits for nobody begins at once") {
  SimulatedRig rig({.screens = 1, .real_time = false});
  rig.run_for(0.5);
  DrivenCircles circles;
  RigClock clock(rig, [&] {
    if (rig.screen(0).link->finished()) report_all(rig);
  });
  const auto served = server::serve(circles, rig.host(), {.ticks = 120}, {}, clock);
  CHECK(served.end == logging::DriveEnd::time_over);
  CHECK(served.wall_s < 1.1);  // Of the simulated clock.
}

}  // namespace septet
