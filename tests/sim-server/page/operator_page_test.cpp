#include <functional>
#include <optional>
#include <set>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "sim-server/page/operator_page.hpp"
#include "tests/sim-server/page/raw_browser.hpp"

namespace septet::page {
namespace {

using json = nlohmann::json;

struct Desk {
  std::unique_ptr<OperatorPage> page;
  std::uint16_t port = 0;

  Desk() {
    auto opened = OperatorPage::open({.token = std::string(token)}, {.scenario = "test"}, {});
    REQUIRE(opened.has_value());
    page = std::move(*opened);
    const std::string url = page->url();
    const auto colon = url.rfind(':');
    port = static_cast<std::uint16_t>(std::stoi(url.substr(colon + 1)));
    CHECK(url.ends_with("/#" + std::string(token)));
  }
  /// The drive thread's next request, as soon as there is one.
  OperatorWish next_wish() {
    while (true)
      if (auto wishes = page->take_wishes(); !wishes.empty()) return wishes.front();
  }
};

/// The next message of a type that meets a condition.
template <class Condition>
json hear(RawBrowser& browser, const std::string& type, Condition holds) {
  while (true) {
    const auto text = browser.hear();
    REQUIRE(text.has_value());
    auto message = json::parse(*text);
    if (message["type"] == type && holds(message)) return message;
  }
}
json answer(RawBrowser& browser, int id) {
  return hear(browser, "answer", [&](const json& message) { return message["id"] == id; });
}
json state_where(RawBrowser& browser, const std::function<bool(const json&)>& holds) {
  return hear(browser, "state", holds);
}

}  // namespace

TEST_CASE("of two browsers one commands, the other is refused until the first lets go") {
  Desk desk;
  RawBrowser anna(desk.port, token), bo(desk.port, token);
  anna.say(R"({"id":1,"do":"take","name":"Anna"})");
  CHECK(answer(anna, 1)["ok"] == true);
  bo.say(R"({"id":1,"do":"take","name":"Bo"})");
  CHECK(answer(bo, 1)["ok"] == false);
  bo.say(R"({"id":2,"do":"pause"})");
  CHECK(answer(bo, 2)["ok"] == false);
  CHECK(desk.page->take_wishes().empty());
  anna.say(R"({"id":2,"do":"mark","note":"sneezed"})");
  const auto wish = desk.next_wish();
  CHECK(wish.name == "Anna");
  CHECK(std::get<Mark>(wish.wish).note == "sneezed");
  desk.page->answer(wish, std::nullopt);
  CHECK(answer(anna, 2)["ok"] == true);
  anna.say(R"({"id":3,"do":"release"})");
  CHECK(answer(anna, 3)["ok"] == true);
  bo.say(R"({"id":3,"do":"take","name":"Bo"})");
  CHECK(answer(bo, 3)["ok"] == true);
  anna.say(R"({"id":4,"do":"take","by_force":true})");
  CHECK(answer(anna, 4)["ok"] == true);
  bo.say(R"({"id":4,"do":"pause"})");
  CHECK(answer(bo, 4)["ok"] == false);
}

TEST_CASE("the command of a browser that is killed is free at once, and what it had asked for is answered to nobody") {
  Desk desk;
  RawBrowser killed(desk.port, token), other(desk.port, token);
  killed.say(R"({"id":1,"do":"take"})");
  CHECK(answer(killed, 1)["ok"] == true);
  state_where(other, [](const json& state) { return !state["commander"].is_null(); });
  killed.say(R"({"id":2,"do":"pause"})");
  const auto wish = desk.next_wish();
  killed.die();
  state_where(other, [](const json& state) { return state["commander"].is_null(); });
  desk.page->answer(wish, std::nullopt);
  other.say(R"({"id":1,"do":"take"})");
  CHECK(answer(other, 1)["ok"] == true);
}

TEST_CASE("the newest view is shown to who is there and to who comes later, with the events") {
  Desk desk;
  RawBrowser early(desk.port, token);
  desk.page->tell({1.5, "message", {}, "something has happened"});
  for (Tick tick = 1; tick <= 1000; ++tick) {
    Snapshot snapshot;
    snapshot.tick = tick;
    desk.page->show({.newest = std::make_shared<const TakenSnapshot>(snapshot), .phase = "driving"});
  }
  const auto is_last = [](const json& state) { return state.value("tick", 0) == 1000; };
  CHECK(state_where(early, is_last)["phase"] == "driving");
  RawBrowser late(desk.port, token);
  CHECK(hear(late, "hello", [](const json&) { return true; })["scenario"] == "test");
  CHECK(hear(late, "event", [](const json&) { return true; })["text"] == "something has happened");
  state_where(late, is_last);
}

TEST_CASE("what a screen shows is sent once to who is there, and to who comes later") {
  Desk desk;
  RawBrowser early(desk.port, token);
  hear(early, "hello", [](const json&) { return true; });
  const auto png = std::make_shared<const std::string>("\x89PNG");
  const auto show = [&](const std::string& phase) {
    desk.page->show({.phase = phase, .screens = {{.name = "ahead", .thumbnail = png}, {.name = "left"}}});
  };
  show("one");
  const auto picture = hear(early, "thumbnail", [](const json&) { return true; });
  CHECK(picture["screen"] == "ahead");
  CHECK(picture["picture"] == "data:image/png;base64,iVBORw==");
  show("two");
  desk.page->tell({1.0, "message", {}, "later"});
  while (true) {  // Nothing comes twice.
    const auto message = json::parse(*early.hear());
    CHECK(message["type"] != "thumbnail");
    if (message["type"] == "state" && message["phase"] == "two") break;
  }
  RawBrowser late(desk.port, token);
  CHECK(hear(late, "thumbnail", [](const json&) { return true; })["screen"] == "ahead");
}

TEST_CASE("what a screen shows large is sent to who watches it, and to nobody else") {
  Desk desk;
  RawBrowser watcher(desk.port, token), other(desk.port, token);
  CHECK(desk.page->watched().empty());
  watcher.say(R"({"id":1,"do":"watch","screen":"ahead"})");
  CHECK(answer(watcher, 1)["ok"] == true);  // A browser without the command may look.
  CHECK(desk.page->watched() == std::set<std::string>{"ahead"});
  const auto large = std::make_shared<const std::string>("\xff\xd8\xff");
  desk.page->show({.phase = "one", .screens = {{.name = "ahead", .large_picture = large}}});
  const auto picture = hear(watcher, "large_picture", [](const json&) { return true; });
  CHECK(picture["screen"] == "ahead");
  CHECK(picture["picture"] == "data:image/jpeg;base64,/9j/");
  desk.page->show({.phase = "two"});
  while (true) {
    const auto message = json::parse(*other.hear());
    CHECK(message["type"] != "large_picture");
    if (message["type"] == "state" && message["phase"] == "two") break;
  }
  watcher.say(R"({"id":2,"do":"watch","screen":""})");
  CHECK(answer(watcher, 2)["ok"] == true);
  CHECK(desk.page->watched().empty());
  other.say(R"({"id":1,"do":"watch","screen":"left"})");
  CHECK(answer(other, 1)["ok"] == true);
  other.die();
  while (!desk.page->watched().empty()) {
  }
}

TEST_CASE("a lesson is sent as it changes, each still once, and all of it to who comes later") {
  Desk desk;
  RawBrowser early(desk.port, token);
  hear(early, "hello", [](const json&) { return true; });
  const auto still = std::make_shared<const std::string>("\xff\xd8");
  LessonView lesson{.tasks = {{.mark = 7.26, .severity = "minor", .faults = 1}}, .mark = 7.26, .faults = {}};
  lesson.faults.push_back(
      {.number = 1, .from_s = 3.0, .to_s = 4.0, .worst = 0.81, .severity = "minor", .still = still});
  desk.page->show({.phase = "one", .lesson = std::make_shared<const LessonView>(lesson)});
  const auto told = hear(early, "lesson", [](const json&) { return true; });
  CHECK(told["mark"] == 7.3);
  CHECK(told["faults"][0]["worst"] == 0.8);
  CHECK(hear(early, "still", [](const json&) { return true; })["fault"] == 1);
  lesson.faults[0].to_s = 5.0;
  desk.page->show({.phase = "two", .lesson = std::make_shared<const LessonView>(lesson)});
  desk.page->tell({1.0, "message", {}, "later"});
  bool heard = false;
  while (true) {
    const auto message = json::parse(*early.hear());
    CHECK(message["type"] != "still");
    heard = heard || (message["type"] == "lesson" && message["faults"][0]["to_s"] == 5.0);
    if (heard) break;
  }
  RawBrowser late(desk.port, token);
  hear(late, "lesson", [](const json&) { return true; });
  CHECK(hear(late, "still", [](const json&) { return true; })["picture"] == "data:image/jpeg;base64,/9g=");
}

TEST_CASE("a wish that is not known or too long is refused by its number, and nothing is done") {
  Desk desk;
  RawBrowser anna(desk.port, token);
  anna.say(R"({"id":1,"do":"take"})");
  CHECK(answer(anna, 1)["ok"] == true);
  const auto refusal = [&](int id, const std::string& said) {
    CHECK(anna.say(said));
    const json refused = answer(anna, id);
    CHECK(refused["ok"] == false);
    return refused["why"].get<std::string>();
  };
  CHECK(refusal(2, R"({"id":2,"do":"fly"})") == "no such wish is known, and nothing was done");
  const json word{{"id", 3}, {"do", "say"}, {"text", std::string(20'000, 'x')}};
  CHECK(refusal(3, word.dump()) == "the message is too long, and nothing was done");
  // Its number stands behind what is too long.
  CHECK(refusal(0, R"({"text":")" + std::string(20'000, 'x') + R"(","id":4,"do":"say"})") ==
        "the message is too long, and nothing was done");
  CHECK(refusal(5, R"({"id":5,"do":"pause")") == "this is no message, and nothing was done");
  CHECK(refusal(0, R"({"do":"pause"})") == "the message has no number, and nothing was done");
  CHECK(desk.page->take_wishes().empty());
  REQUIRE(anna.say(R"({"id":6,"do":"mark","note":"goes on"})"));
  CHECK(std::get<Mark>(desk.next_wish().wish).note == "goes on");
}

TEST_CASE("more wishes than the drive has done are refused, not kept") {
  Desk desk;
  RawBrowser eager(desk.port, token);
  eager.say(R"({"id":1,"do":"take"})");
  for (int i = 2; i < 102; ++i) eager.say(fmt::format(R"({{"id":{},"do":"pause"}})", i));
  CHECK(answer(eager, 101)["ok"] == false);
  CHECK(desk.page->take_wishes().size() == most_waiting_wishes);
}

TEST_CASE("a page without browsers costs the drive no memory and ends at once") {
  Desk desk;
  const auto snapshot = std::make_shared<const TakenSnapshot>(Snapshot{});
  for (int i = 0; i < 10000; ++i) desk.page->show({.newest = snapshot, .phase = "driving"});
  // Here, in the slot, in the shown state, and, while the page takes over, in the state before it.
  CHECK(snapshot.use_count() <= 4);
}

}  // namespace septet::page
