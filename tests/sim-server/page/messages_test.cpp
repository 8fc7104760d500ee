#include <cmath>
#include <limits>
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "sim-server/page/messages.hpp"

namespace septet::page {
using json = nlohmann::json;

TEST_CASE("each wish is read as it was written") {
  CHECK(std::get<Take>(read_browser_message(R"({"id":1,"do":"take","name":"Anna","by_force":true})")->wish).by_force);
  CHECK(!std::get<Take>(read_browser_message(R"({"id":1,"do":"take"})")->wish).by_force);
  CHECK(std::get<Mark>(read_browser_message(R"({"id":2,"do":"mark","note":"sneezed"})")->wish).note == "sneezed");
  CHECK(std::get<End>(read_browser_message(R"({"id":3,"do":"end","reason":"sick"})")->wish).reason == "sick");
  CHECK_FALSE(std::get<End>(read_browser_message(R"({"id":3,"do":"end","reason":"sick"})")->wish).participant_stops);
  CHECK(std::get<End>(read_browser_message(R"({"id":3,"do":"end","participant_stops":true})")->wish).participant_stops);
  CHECK(std::get<Change>(read_browser_message(R"({"id":4,"do":"change","command":"traffic vehicles=3"})")->wish)
            .command == "traffic vehicles=3");
  CHECK(std::holds_alternative<Pause>(read_browser_message(R"({"id":5,"do":"pause"})")->wish));
  CHECK(std::holds_alternative<Rearm>(read_browser_message(R"({"id":6,"do":"rearm"})")->wish));
  CHECK(std::holds_alternative<GoOn>(read_browser_message(R"({"id":6,"do":"go_on"})")->wish));
  CHECK(std::get<Restart>(read_browser_message(R"({"id":7,"do":"restart","at_s":20})")->wish).at_s == 20.0);
  // A time that is none is later than any drive, and is refused.
  for (const char* at_s : {"-10", "1.5", "\"10\"", "null"})
    CHECK(std::get<Restart>(read_browser_message(R"({"id":7,"do":"restart","at_s":)" + std::string(at_s) + "}")->wish)
              .at_s > 1e9);
  CHECK(std::holds_alternative<Release>(read_browser_message(R"({"id":7,"do":"release"})")->wish));
  CHECK(read_browser_message(R"({"id":18446744073709551615,"do":"pause"})")->id ==
        std::numeric_limits<std::uint64_t>::max());
}

TEST_CASE("lines of an edit, a place on the map and a name to save by are read as they were written") {
  CHECK(std::get<Edit>(read_browser_message(R"({"id":1,"do":"edit","lines":"hide \"a b\"\nshow c"})")->wish).lines ==
        "hide \"a b\"\nshow c");
  const auto near =
      std::get<FindNear>(read_browser_message(R"({"id":2,"do":"find_near","x_m":-3.5,"y_m":4,"within_m":20})")->wish);
  CHECK(near.x_m == -3.5);
  CHECK(near.y_m == 4.0);
  CHECK(near.within_m == 20.0);
  CHECK(std::isnan(std::get<FindNear>(read_browser_message(R"({"id":2,"do":"find_near","x_m":"4"})")->wish).x_m));
  CHECK(std::get<SaveEdits>(read_browser_message(R"({"id":3,"do":"save_edits","name":"town"})")->wish).name == "town");
}

TEST_CASE("answers to a questionnaire are read by item, and what is no whole number is kept as none") {
  const auto message = read_browser_message(
      R"({"id":8,"do":"answer","session":7,"questionnaire":"paper","as":"paper-2","answers":{"a":3,"b":-1,"c":2.5,"d":"4","e":1e300}})");
  REQUIRE(message.has_value());
  const auto& answer = std::get<Answer>(message->wish);
  CHECK(answer.session == 7);
  CHECK(answer.questionnaire == "paper");
  CHECK(answer.as == "paper-2");
  const std::vector<std::pair<std::string, std::optional<int>>> expected{
      {"a", 3}, {"b", -1}, {"c", std::nullopt}, {"d", std::nullopt}, {"e", std::nullopt}};
  CHECK(answer.answers == expected);
  CHECK(std::get<Answer>(read_browser_message(R"({"id":8,"do":"answer","answers":[1]})")->wish).answers.empty());
}

TEST_CASE("what is no message is refused, and what is said becomes one printable line") {
  for (const char* text : {"", "{", "[]", "1", "null", R"({"do":"pause"})", R"({"id":-1,"do":"pause"})",
                           R"({"id":1.5,"do":"pause"})", R"({"id":"1","do":"pause"})", R"({"id":1})",
                           R"({"id":1,"do":"fly"})", R"({"id":1,"do":["pause"]})", "\xff\xfe"})
    CHECK_MESSAGE(!read_browser_message(text).has_value(), text);
  CHECK(!read_browser_message(std::string(16000, '[')).has_value());
  const auto note =
      std::get<Mark>(read_browser_message(
                         json{{"id", 1}, {"do", "mark"}, {"note", "a\nb\x1b[31m" + std::string(9000, 'x')}}.dump())
                         ->wish)
          .note;
  CHECK(note.find('\n') == std::string::npos);
  CHECK(note.find('\x1b') == std::string::npos);
  CHECK(note.size() < 2 * most_note_characters);
  CHECK(std::get<Mark>(read_browser_message(R"({"id":1,"do":"mark","note":{"a":1}})")->wish).note.empty());
}

TEST_CASE("a state with numbers gone bad is still JSON, with nothing in their places") {
  Snapshot snapshot;
  snapshot.tick = 7;
  snapshot.driver_car.speed_mps = std::numeric_limits<double>::quiet_NaN();
  snapshot.driver_car.lateral_position_m = std::numeric_limits<double>::infinity();
  Participant far;
  far.id = 3;
  far.world_from_vehicle.position_m = {1e300, 0.0, 0.0};
  snapshot.participants.push_back(far);
  DriveView view{.newest = std::make_shared<const TakenSnapshot>(snapshot), .phase = "driving \xff"};
  view.conditions = {std::numeric_limits<double>::quiet_NaN(), 2.0};
  view.screens.push_back({.name = "ahead", .live = true, .presented = 5});
  const auto state = json::parse(state_text(view, {}, 1, Commander{2, "Anna"}, 1));
  CHECK(state["tick"] == 7);
  CHECK(state["car"]["speed_mps"].is_null());
  CHECK(state["car"]["lateral_m"].is_null());
  CHECK(state["everybody"][0][2].is_null());
  CHECK(state["conditions"][0].is_null());
  CHECK(state["conditions"][1] == 2.0);
  CHECK(state["commander"]["name"] == "Anna");
  CHECK(json::parse(state_text({}, {}, 1, std::nullopt, 0))["commander"].is_null());
}

TEST_CASE("a state says why actuators are cut and what the driver reads, and nothing where there are none") {
  const auto said = [](const DriveView& view) { return json::parse(state_text(view, {}, 1, std::nullopt, 0)); };
  CHECK(said({})["actuators"].is_null());
  CHECK(said({.has_actuators = true})["actuators"]["cut"].is_null());
  const auto cut = said({.has_actuators = true, .fault = "the CAN bus is lost", .alarm = "Emergency stop"});
  CHECK(cut["actuators"]["cut"] == "the CAN bus is lost");
  CHECK(cut["alarm"] == "Emergency stop");
}

TEST_CASE("a fault of a car without actuators is told as the fault, and cuts nothing") {
  const auto state = json::parse(state_text({.fault = "the controls have stopped"}, {}, 1, std::nullopt, 0));
  CHECK(state["actuators"].is_null());
  CHECK(state["fault"] == "the controls have stopped");
}

TEST_CASE("who is behind is told against the foremost screen, and who is away has no such time") {
  DriveView view;
  view.screens = {{.name = "a", .live = true, .presented = 120},
                  {.name = "b", .live = true, .presented = 114},
                  {.name = "c", .live = false}};
  const auto screens = json::parse(state_text(view, {}, 1, std::nullopt, 1))["screens"];
  CHECK(screens[0]["behind_ms"] == 0.0);
  CHECK(screens[1]["behind_ms"] == 50.0);
  CHECK(screens[2]["behind_ms"].is_null());
}

}  // namespace septet::page
