#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <utility>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "sim-server/page/listening_socket.hpp"
#include "sim-server/page/start_page.hpp"
#include "tests/sim-server/page/raw_browser.hpp"

namespace septet::page {
namespace {

namespace fs = std::filesystem;
using json = nlohmann::json;

struct Folder {
  fs::path path;
  Folder() {
    std::string made = (fs::temp_directory_path() / "septet-start-XXXXXX").string();
    REQUIRE(::mkdtemp(made.data()) != nullptr);
    path = made;
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  void write(const fs::path& name, const std::string& text) const {
    fs::create_directories((path / name).parent_path());
    std::ofstream(path / name) << text;
  }
};

json hear_of(RawBrowser& browser, const std::string& type) {
  while (true) {
    const auto text = browser.hear();
    REQUIRE(text.has_value());
    auto message = json::parse(*text);
    if (message["type"] == type) return message;
  }
}

struct Waiting {
  ListeningSocket listening = ListeningSocket::open(0).value();
  std::unique_ptr<StartPage> page =
      StartPage::open(listening, std::string(token), {}, {.scenarios = {{{"a", "about a"}, {{"x", "1"}}}}}).value();

  std::string get(const std::string& path) const {
    RawConnection connection(listening.port());
    connection.send(fmt::format("GET {} HTTP/1.1\r\nHost: localhost\r\n\r\n", path));
    connection.send_no_more();
    return connection.read_all();
  }
};

}  // namespace

TEST_CASE("a past drive's report is read at an address that cannot be guessed, and nothing beside it") {
  const Folder outside, drive;
  outside.write("secret.html", "secret");
  drive.write("report.html", "<p>report");
  drive.write("session.sqlite", "secret");
  drive.write("screens/ahead/120.png", "picture");
  fs::create_symlink(outside.path / "secret.html", drive.path / "debrief.html");
  Waiting waiting;
  StartView view;
  view.sessions.push_back({.id = 7, .folder = "<b>", .has_report = true});
  waiting.page->show(view, {drive.path});
  RawBrowser browser(waiting.listening.port(), token);
  while (hear_of(browser, "start_state")["sessions"].empty()) {
  }
  const auto look = [&](int session, const std::string& file) {
    browser.say(json{{"id", 1}, {"do", "look"}, {"session", session}, {"file", file}}.dump());
    return hear_of(browser, "answer");
  };
  const std::string path = "/" + look(7, "report.html")["path"].get<std::string>();
  const std::string report = waiting.get(path);
  CHECK(report.starts_with("HTTP/1.1 200"));
  CHECK(report.find("<p>report") != std::string::npos);
  CHECK(report.find("script-src") == std::string::npos);
  CHECK(report.find("default-src 'none'") != std::string::npos);
  const std::string folder = path.substr(0, path.rfind('/') + 1);
  CHECK(waiting.get(folder + "screens/ahead/120.png").find("picture") != std::string::npos);
  for (const char* name : {"session.sqlite", "debrief.html", "../report.html", "screens/../report.html", "%2e%2e/x",
                           "screens/ahead/../../session.sqlite.png", "", "/etc/passwd"})
    CHECK_MESSAGE(waiting.get(folder + name).starts_with("HTTP/1.1 404"), name);
  CHECK(waiting.get("/past/" + std::string(32, '0') + "/report.html").starts_with("HTTP/1.1 404"));
  CHECK(look(7, "session.sqlite")["ok"] == false);
  CHECK(look(8, "report.html")["ok"] == false);
}

TEST_CASE("who does not command starts nothing, and who does hands over what was chosen as it was typed") {
  Waiting waiting;
  RawBrowser anna(waiting.listening.port(), token), bo(waiting.listening.port(), token);
  anna.say(R"({"id":1,"do":"take","name":"Anna"})");
  CHECK(hear_of(anna, "answer")["ok"] == true);
  bo.say(R"({"id":1,"do":"start","scenario":"a"})");
  CHECK(hear_of(bo, "answer")["ok"] == false);
  bo.say(R"({"id":2,"do":"answer","session":1,"questionnaire":"paper","answers":{"fun":3}})");
  CHECK(hear_of(bo, "answer")["ok"] == false);
  anna.say(R"({"id":2,"do":"pause"})");
  CHECK(hear_of(anna, "answer")["ok"] == false);
  anna.say(
      R"({"id":3,"do":"start","scenario":"a","seed":"18446744073709551615","seconds":5,"parameters":{"x":"2","y":3}})");
  std::vector<OperatorWish> wishes;
  while (wishes.empty()) wishes = waiting.page->take_wishes();
  const auto& choice = std::get<Start>(wishes.front().wish).choice;
  CHECK(choice.scenario == "a");
  CHECK(choice.seed == "18446744073709551615");
  CHECK(choice.seconds.empty());  // No text.
  anna.say(R"({"id":4,"do":"answer","session":1,"questionnaire":"paper","answers":{"fun":3}})");
  std::vector<OperatorWish> answers;
  while (answers.empty()) answers = waiting.page->take_wishes();
  CHECK(std::get<Answer>(answers.front().wish).session == 1);
  CHECK(choice.parameters == std::vector<std::pair<std::string, std::string>>{{"x", "2"}});
}

TEST_CASE("a port is handed from one page to the next, and who connects meanwhile is served by the next") {
  std::optional<Waiting> waiting(std::in_place);
  const auto kept = ListeningSocket::take(waiting->listening.copy(true).value()).value();
  RawBrowser early(kept.port(), token);
  hear_of(early, "start_state");
  waiting.reset();
  CHECK(hear_of(early, "moved")["type"] == "moved");
  CHECK_FALSE(early.hear().has_value());
  RawConnection late(kept.port());
  late.send("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n");
  const auto next = StartPage::open(kept, std::string(token), {}, {}).value();
  CHECK(late.read_all().starts_with("HTTP/1.1 200"));
}

TEST_CASE("only a port of this machine and a whole token are taken for a page that is handed over") {
  const auto handed = read_handover("5 " + std::string(token));
  REQUIRE(handed.has_value());
  CHECK(handed->files.ipv4 == 5);
  CHECK(handed->files.ipv6 == -1);
  CHECK(handed->token == token);
  CHECK(text_of(*handed) == "5 " + std::string(token));
  const auto both = read_handover("5+6 " + std::string(token));
  REQUIRE(both.has_value());
  CHECK(both->files.ipv6 == 6);
  CHECK(text_of(*both) == "5+6 " + std::string(token));
  for (const char* text :
       {"", "5", "5 ", "5 0123", "5+ 0123456789abcdef0123456789abcdef", "5+1 0123456789abcdef0123456789abcdef",
        "+5 0123456789abcdef0123456789abcdef", "1 0123456789abcdef0123456789abcdef",
        "5 0123456789abcdef0123456789abcdeX", "99999999999 0123456789abcdef0123456789abcdef"})
    CHECK_FALSE_MESSAGE(read_handover(text).has_value(), text);
  CHECK_FALSE(ListeningSocket::take({1000}).has_value());
  int pipe_ends[2];
  REQUIRE(::pipe(pipe_ends) == 0);
  CHECK_FALSE(ListeningSocket::take({pipe_ends[0]}).has_value());
  ::close(pipe_ends[0]);
  ::close(pipe_ends[1]);
}

TEST_CASE("a port that another program has on one of the two addresses is refused, for a browser might ask that one") {
  auto other = ListeningSocket::open(0).value().copy().value();
  if (other.ipv6 < 0) return;  // No IPv6 here.
  sockaddr_in6 place{};
  socklen_t size = sizeof place;
  REQUIRE(::getsockname(other.ipv6, reinterpret_cast<sockaddr*>(&place), &size) == 0);
  ::close(std::exchange(other.ipv4, -1));
  const auto refused = ListeningSocket::open(ntohs(place.sin6_port));
  REQUIRE_FALSE(refused.has_value());
  CHECK(refused.error().where.find("[::1]:") != std::string::npos);
  // Two of different ports are no page's, nor is one of IPv6 in the place of the other.
  auto mine = ListeningSocket::open(0).value().copy().value();
  CHECK_FALSE(ListeningSocket::take({mine.ipv4, other.ipv6}).has_value());
  CHECK_FALSE(ListeningSocket::take({-1, mine.ipv6}).has_value());
  mine.close();
  other.close();
}

}  // namespace septet::page
