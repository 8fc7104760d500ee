#include <functional>
#include <optional>

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
  /// What the drive's thread is asked, as soon as it is.
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
  desk.page->tell(1.5, "something has happened");
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
  desk.page->tell(1.0, "later");
  while (true) {  // Nothing comes twice.
    const auto message = json::parse(*early.hear());
    CHECK(message["type"] != "thumbnail");
    if (message["type"] == "state" && message["phase"] == "two") break;
  }
  RawBrowser late(desk.port, token);
  CHECK(hear(late, "thumbnail", [](const json&) { return true; })["screen"] == "ahead");
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
  CHECK(snapshot.use_count() <= 3);  // Here, in the slot, and as what is shown.
}

}  // namespace septet::page
