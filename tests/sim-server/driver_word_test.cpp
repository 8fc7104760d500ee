#include "sim-server/drive/driver_word.hpp"

#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/world/vehicle_model.hpp"

namespace septet::server {
namespace {

/// Half a second after half a second, on a lane with a running engine unless said otherwise.
struct Told {
  DriverWord word;
  Snapshot now;
  explicit Told(bool by_keyboard = true) : word(by_keyboard) {
    now.driver_car.lane = -1;
    now.driver_car.engine_radps = 80.0;
  }
  std::string after(double seconds, std::vector<simulation::Event> events = {}) {
    word.take(now, events);
    for (int i = 0; i < static_cast<int>(2.0 * seconds); ++i) {
      now.tick += 60;
      now.simulated_time_s += 0.5;
      word.take(now, {});
    }
    return word.text();
  }
};

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("a driver who has hit something reads what and how fast, and what to press, for some seconds") {
  Told told;
  CHECK(told.after(5.0).empty());
  const std::string text =
      told.after(0.0, {{"collision", std::nullopt, "tree closing_speed_mps=41.58 delta_v_mps=43.49"}});
  CHECK(has(text, "You have hit a tree at 150 km/h."));
  CHECK(has(text, "Escape, then R: begin again"));
  CHECK(has(told.after(7.0), "tree"));
  CHECK(told.after(1.5).empty());
}

TEST_CASE("a driver who was run into reads who it was, and not that he has hit somebody") {
  Told told;
  told.now.participants = {{.id = 7, .model = *find_vehicle_model("saloon")}};
  const std::string text =
      told.after(0.0, {{"collision", ParticipantId{7}, "closing_speed_mps=10.00 delta_v_mps=5.00 by=other"}});
  CHECK(has(text, "A saloon has run into you at 36 km/h."));
  CHECK_FALSE(has(text, "You have hit"));
  CHECK(told.after(9.0).empty());
  CHECK(has(told.after(0.0, {{"collision", ParticipantId{7}, "closing_speed_mps=10.00 delta_v_mps=5.00 by=driver"}}),
            "You have hit a saloon"));
}

TEST_CASE("of the blows of one crash the worst is told, a touch is not, and words that are none do no harm") {
  Told told;
  told.now.participants = {{.id = 7, .model = *find_vehicle_model("ambulance")}};
  CHECK(has(told.after(0.0, {{"collision", ParticipantId{7}, "closing_speed_mps=10.00"}}),
            "hit an ambulance at 36 km/h"));
  CHECK(has(told.after(1.0, {{"collision", std::nullopt, "guard_rail closing_speed_mps=4.00 delta_v_mps=1"}}),
            "ambulance"));
  CHECK(has(told.after(1.0, {{"collision", ParticipantId{99}, "closing_speed_mps=20.00"}}), "somebody at 72"));
  CHECK(told.after(9.0).empty());
  for (const char* detail :
       {"", "closing_speed_mps=", "closing_speed_mps=nan", "closing_speed_mps=1.5", "tree", " closing_speed_mps=x"})
    CHECK(told.after(0.0, {{"collision", std::nullopt, detail}}).empty());
  CHECK(has(told.after(0.0, {{"collision", std::nullopt, "closing_speed_mps=5"}}), "hit something at 18 km/h"));
  CHECK(told.after(9.0, {{"kerb", std::nullopt, "closing_speed_mps=50"}}).empty());
}

TEST_CASE("whence the blow came and what it changed is told once it is known, also where it is known first") {
  CrashRecord crash;
  crash.first = 1;
  crash.second = 7;
  crash.closing_speed_mps = 10.0;
  crash.of_first.delta_v_mps = Vec2(-5.0, 0.0);
  crash.of_first.principal_direction_rad = 0.7;
  const simulation::Event record{"crash", ParticipantId{1}, text_of(crash)},
      touch{"collision", ParticipantId{7}, "closing_speed_mps=10.00"};
  const std::string outcome = "The blow came from ahead, left and changed your speed by 18 km/h.";
  for (const bool record_first : {false, true}) {
    Told told;
    told.now.driver_car.participant = 1;
    CHECK_FALSE(has(told.after(0.0, {record_first ? record : touch}), outcome));
    const std::string text = told.after(0.1, {record_first ? touch : record});
    CHECK(has(text, "You have hit somebody at 36 km/h.\n" + outcome));
    CHECK(has(text, "Escape, then R: begin again"));
  }
  Told other;
  other.now.driver_car.participant = 1;
  other.after(0.0, {touch, {"crash", ParticipantId{2}, text_of(crash)}, {"crash", ParticipantId{1}, "version=9"}});
  CHECK_FALSE(has(other.word.text(), "blow"));
}

TEST_CASE("off every lane and a stall are told of once they have lasted, and no longer than they last") {
  Told told;
  CHECK(told.after(1.0).empty());
  told.now.driver_car.lane = 0;
  CHECK(told.after(3.0).empty());
  CHECK(has(told.after(1.5), "You are off the road."));
  CHECK(has(told.after(100.0), "off the road"));
  told.now.driver_car.lane = 2;
  CHECK(told.after(0.5).empty());
  told.now.driver_car.engine_radps = 0.0;
  CHECK(told.after(1.0).empty());
  CHECK(has(told.after(2.0), "stalled: V held"));
  told.now.driver_car.engine_radps = 90.0;
  CHECK(told.after(0.5).empty());
  Told pedals(false);
  pedals.now.driver_car.engine_radps = 0.0;
  CHECK(has(pedals.after(4.0), "the clutch starts it"));
  CHECK_FALSE(has(pedals.after(4.0), "V held"));
}

TEST_CASE(
    "a drive that begins at a later time, off every lane or with a stalled engine, is told so after the same while") {
  Told off;
  off.now.tick = 1201;
  off.now.simulated_time_s = 10.0;
  off.now.driver_car.lane = 0;
  off.now.driver_car.engine_radps = 0.0;
  CHECK(off.after(1.5).empty());
  CHECK(has(off.after(1.0), "stalled"));
  CHECK(has(off.after(2.0), "You are off the road."));
}

TEST_CASE("at its own end a drive says that it is over, of a lesson where its mark is, and what to press") {
  using enum logging::DriveEnd;
  CHECK(words_at_end(stop_trigger, true) ==
        "The lesson is over.\nThe debrief has its mark.\nR: begin again. Enter: end.");
  CHECK(has(words_at_end(time_over, false), "The drive is over: its time has passed."));
  CHECK(has(words_at_end(road_end, true), "The lesson is over: the road ends here."));
  CHECK(has(words_at_end(game_over, false), "The game is over."));
  for (const auto end : {stop_trigger, time_over, road_end, game_over})
    CHECK(has(words_at_end(end, false), "R: begin again. Enter: end."));
}

}  // namespace septet::server
