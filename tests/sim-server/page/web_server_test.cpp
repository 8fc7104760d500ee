#include <algorithm>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <vector>

#include <doctest/doctest.h>

#include "engine/core/random.hpp"
#include "sim-server/page/web_server.hpp"
#include "tests/sim-server/page/raw_browser.hpp"

namespace septet::page {
namespace {

/// A running server that echoes messages, and counts.
struct Echo {
  std::mutex mutex;
  std::condition_variable changed;
  int opened = 0, said = 0, closed = 0;
  std::unique_ptr<WebServer> server;

  explicit Echo(std::vector<std::string> hosts = {}) {
    std::unique_lock starting(mutex);
    auto started = WebServer::start(
        {.allowed_hosts = std::move(hosts),
         .token = std::string(token),
         .resources = {{"/", "text/html; charset=utf-8", "<p>page"}, {"/page.js", "text/javascript", "let x;"}}},
        {[this](BrowserId) { count(opened); },
         [this](BrowserId id, std::string_view text) {
           count(said);
           server->send(id, std::make_shared<const std::string>(text));
         },
         [this](BrowserId) { count(closed); }});
    REQUIRE(started.has_value());
    server = std::move(*started);
  }
  void count(int& what) {
    const std::lock_guard lock(mutex);
    ++what;
    changed.notify_all();
  }
  int now(const int& what) {
    const std::lock_guard lock(mutex);
    return what;
  }
  template <class Condition>
  void wait_until(Condition holds) {
    std::unique_lock lock(mutex);
    changed.wait(lock, holds);
  }
  std::string answer_to(std::string_view request) {
    RawConnection connection(server->port());
    connection.send(request);
    connection.send_no_more();
    return connection.read_all();
  }
  std::string status_of(std::string_view request) {
    const std::string answer = answer_to(request);
    return answer.substr(0, answer.find('\r'));
  }
  std::string get(std::string_view path, std::string_view more = "") {
    return answer_to(fmt::format("GET {} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\n{}\r\n", path, server->port(), more));
  }
  bool works() {
    if (get("/").find("<p>page") == std::string::npos) return false;
    RawBrowser browser(server->port(), token);
    return browser.say("hello") && browser.hear() == "hello";
  }
};

/// A valid text, spoiled: cut, with bytes turned, put in, taken out or doubled.
std::string spoiled(std::string text, Random& random) {
  for (auto times = 1 + random.below(6); times > 0; --times) {
    const auto at = random.below(text.size() + 1);
    switch (random.below(6)) {
      case 0:
        text.resize(at);
        break;
      case 1:
        text.insert(at, 1 + random.below(4), static_cast<char>(random.below(256)));
        break;
      case 2:
        if (at < text.size()) text[at] = static_cast<char>(random.below(256));
        break;
      case 3:
        if (at < text.size()) text.erase(at, 1 + random.below(20));
        break;
      case 4:
        text.insert(at, text.substr(random.below(text.size() + 1), random.below(200)));
        break;
      default:
        text.insert(at, random.below(20) == 0 ? std::string(20000, 'x') : "\r\n\r\n");
    }
  }
  return text;
}

}  // namespace

TEST_CASE("the page is served with headers that keep other sites out, to this machine's names only") {
  Echo echo;
  const std::string page = echo.get("/");
  CHECK(page.starts_with("HTTP/1.1 200"));
  CHECK(page.find("default-src 'none'") != std::string::npos);
  CHECK(page.find("nosniff") != std::string::npos);
  CHECK(page.find("Access-Control") == std::string::npos);
  CHECK(echo.get("/page.js").find("let x;") != std::string::npos);
  CHECK(echo.get("/../etc/passwd").starts_with("HTTP/1.1 404"));
  CHECK(echo.get("http://127.0.0.1/").starts_with("HTTP/1.1 404"));
  CHECK(echo.status_of("GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n") == "HTTP/1.1 403 Forbidden");
  CHECK(echo.status_of("GET / HTTP/1.1\r\n\r\n") == "HTTP/1.1 403 Forbidden");
  CHECK(echo.status_of("GET / HTTP/1.1\r\nHost: localhost\r\nHost: evil.example\r\n\r\n") == "HTTP/1.1 403 Forbidden");
  CHECK(echo.status_of("POST / HTTP/1.1\r\nHost: localhost\r\n\r\n") == "HTTP/1.1 405 Method Not Allowed");
  const std::string head = echo.answer_to("HEAD / HTTP/1.1\r\nHost: localhost\r\n\r\n");
  CHECK(head.find("Content-Length: 7") != std::string::npos);
  CHECK(head.find("<p>page") == std::string::npos);
  CHECK(Echo({"sim.example"}).status_of("GET / HTTP/1.1\r\nHost: sim.example\r\n\r\n") == "HTTP/1.1 200 OK");
}

TEST_CASE("without the token, or from another site, no socket opens and nothing is heard") {
  Echo echo;
  const auto port = echo.server->port();
  const auto status = [&](const std::string& request) { return echo.status_of(request).substr(0, 12); };
  CHECK(status(upgrade_request(port, "wrong")) == "HTTP/1.1 403");
  CHECK(status(upgrade_request(port, std::string(32, '0'))) == "HTTP/1.1 403");
  CHECK(status(upgrade_request(port, "")) == "HTTP/1.1 403");
  for (const char* origin : {"http://evil.example", "null", "http://localhost:1", "https://127.0.0.1.evil.example"})
    CHECK_MESSAGE(status(upgrade_request(port, token, fmt::format("Origin: {}\r\n", origin))) == "HTTP/1.1 403",
                  origin);
  CHECK(status(upgrade_request(port, token,
                               fmt::format("Origin: http://127.0.0.1:{0}\r\nOrigin: http://evil.example\r\n", port))) ==
        "HTTP/1.1 403");
  CHECK(echo.get("/live").starts_with("HTTP/1.1 426"));
  CHECK(echo.now(echo.opened) == 0);
  CHECK(status(upgrade_request(port, token, fmt::format("Origin: http://127.0.0.1:{}\r\n", port))) == "HTTP/1.1 101");
  CHECK(echo.works());
}

TEST_CASE("ten thousand spoiled requests and frames harm nobody, and valid ones work afterwards") {
  Echo echo;
  Random random(20);
  const auto port = echo.server->port();
  const std::string requests[] = {
      fmt::format("GET / HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nAccept: */*\r\n\r\n", port), upgrade_request(port, token),
      "POST / HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n5\r\nhello\r\n0\r\n\r\n"};
  for (int i = 0; i < 5000; ++i) {
    echo.answer_to(spoiled(requests[random.below(3)], random));
    if (i % 1000 == 0) CHECK(echo.works());
  }
  CHECK(echo.works());
  int frames = 0;
  while (frames < 5000) {
    RawBrowser browser(port, token);
    for (bool is_open = true; is_open && frames < 5000; ++frames) {
      std::string frame =
          client_frame(std::string(random.below(300), '{'), static_cast<unsigned char>(random.below(256)));
      if (random.below(3) == 0) frame = spoiled(frame, random);
      if (random.below(10) == 0) frame[1] = static_cast<char>(random.below(256));
      is_open = browser.send(frame) && random.below(8) != 0;
    }
    browser.connection().send_no_more();
    browser.connection().read_all();
  }
  CHECK(echo.works());
  // Each that was opened is closed again, once.
  echo.wait_until([&] { return echo.closed == echo.opened; });
}

TEST_CASE("a header that is too long ends its connection") {
  Echo echo;
  CHECK(echo.get("/", "X: " + std::string(2 * most_header_bytes, 'x') + "\r\n").find("200 OK") == std::string::npos);
  CHECK(echo.works());
}

TEST_CASE("of a message that is too long the beginning is told, and the next one is read as usual") {
  Echo echo;
  RawBrowser browser(echo.server->port(), token);
  for (const std::size_t size :
       {most_message_bytes, most_message_bytes + 1, std::size_t{20'000}, std::size_t{65'000}}) {
    CAPTURE(size);
    CHECK(browser.say("{" + std::string(size - 1, 'x')));
    const auto heard = browser.hear();
    REQUIRE(heard.has_value());
    CHECK(heard->size() == std::min(size, most_message_bytes + 1));
    CHECK(heard->starts_with("{x"));
  }
  CHECK(browser.say("short"));
  CHECK(browser.hear() == "short");
  CHECK(echo.now(echo.said) == 5);
}

TEST_CASE("a message without end is not read for ever: its connection is closed") {
  Echo echo;
  RawBrowser browser(echo.server->port(), token);
  bool is_open = browser.send(client_frame("a", 0x01));  // A text of which more is to come.
  for (std::size_t sent = 0; is_open && sent < 4 * most_read_bytes; sent += 60'000)
    is_open = browser.send(client_frame(std::string(60'000, 'x'), 0x00));
  CHECK_FALSE(browser.hear().has_value());
  CHECK(echo.now(echo.said) == 0);
  CHECK(echo.works());
}

TEST_CASE("a browser that is killed is gone for the server, and one beside it goes on") {
  Echo echo;
  RawBrowser stays(echo.server->port(), token);
  {
    RawBrowser killed(echo.server->port(), token);
    CHECK(killed.say("a"));
    CHECK(killed.hear() == "a");
    killed.die();
  }
  echo.wait_until([&] { return echo.closed == 1; });
  CHECK(stays.say("b"));
  CHECK(stays.hear() == "b");
}

TEST_CASE("no more browsers than there is room for, and one more when one has left") {
  Echo echo;
  std::vector<std::unique_ptr<RawBrowser>> browsers;
  for (std::size_t i = 0; i < most_browsers; ++i)
    browsers.push_back(std::make_unique<RawBrowser>(echo.server->port(), token));
  CHECK(echo.status_of(upgrade_request(echo.server->port(), token)).starts_with("HTTP/1.1 503"));
  browsers.pop_back();
  echo.wait_until([&] { return echo.closed == 1; });
  CHECK(echo.works());
}

TEST_CASE("who reads slowly is sent the newest state and not those between, and holds nobody up") {
  Echo echo;
  RawBrowser slow(echo.server->port(), token, 4096), quick(echo.server->port(), token);
  echo.wait_until([&] { return echo.opened == 2; });
  constexpr int states = 2000;
  const std::string ballast(20000, '.');
  for (int i = 0; i < states; ++i) {
    const auto state = std::make_shared<const std::string>(fmt::format("{:06}{}", i, ballast));
    echo.server->post([&server = *echo.server, state] {
      for (const BrowserId browser : {1, 2}) server.send_newest(browser, state);
    });
    if (i % 100 == 0) CHECK(quick.hear().has_value());  // The slow one delays no other.
  }
  int last = -1;
  while (last != states - 1) {
    const auto heard = quick.hear();
    REQUIRE(heard.has_value());
    const int number = std::stoi(heard->substr(0, 6));
    CHECK(number > last);
    last = number;
  }
  int count = 0;
  for (last = -1; last != states - 1; ++count) {
    const auto heard = slow.hear();
    REQUIRE(heard.has_value());
    const int number = std::stoi(heard->substr(0, 6));
    REQUIRE(number > last);
    last = number;
  }
  CHECK(count < states);
  CHECK(echo.server->counters().states_left_out > 0);
}

TEST_CASE("messages to a browser that takes none are bounded: it is closed") {
  Echo echo;
  RawBrowser deaf(echo.server->port(), token, 4096);
  echo.wait_until([&] { return echo.opened == 1; });
  const auto message = std::make_shared<const std::string>(std::string(100000, '.'));
  echo.server->post([&server = *echo.server, message] {
    for (std::size_t i = 0; i < most_waiting_messages + 2; ++i) server.send(1, message);
  });
  echo.wait_until([&] { return echo.closed == 1; });
  CHECK(echo.works());
}

TEST_CASE("whoever holds hundreds of connections without a whole request shuts nobody out") {
  Echo echo;
  const std::string whole = fmt::format("GET /page.js HTTP/1.1\r\nHost: 127.0.0.1:{}\r\n\r\n", echo.server->port());
  std::string posted = whole;
  posted.replace(0, 3, "POST");
  // Nothing, a byte, all but the last one, a chunked body that never comes, and a whole request whose reply is not
  // read.
  const std::string held[] = {"", "G", whole.substr(0, whole.size() - 1),
                              posted.substr(0, posted.size() - 2) + "Transfer-Encoding: chunked\r\n\r\n", whole};
  for (const std::string& words : held) {
    CAPTURE(words);
    std::deque<RawConnection> holding;
    for (int i = 0; i < 600; ++i) {
      holding.emplace_back(echo.server->port());
      holding.back().send(words);
      if (i % 100 == 99) CHECK(echo.works());
    }
    RawBrowser stays(echo.server->port(), token);  // An accepted browser is not displaced.
    for (int i = 0; i < 300; ++i) {
      holding.emplace_back(echo.server->port());
      holding.back().send(words);
      holding.pop_front();
    }
    CHECK(stays.say("still here"));
    CHECK(stays.hear() == "still here");
    CHECK(echo.works());
  }
}

TEST_CASE("a request with a body is answered at once, by length or in chunks, also where the body never comes") {
  Echo echo;
  const std::string_view rests[] = {"Transfer-Encoding: chunked\r\n\r\n", "Content-Length: 5\r\n\r\n",
                                    "Content-Length: 5\r\nExpect: 100-continue\r\n\r\n",
                                    "Transfer-Encoding: gzip, chunked\r\n\r\n5\r\nhe"};
  for (const std::string_view rest : rests)
    for (const char* begin : {"POST /", "GET /", "PUT /page.js", "POST /live"}) {
      CAPTURE(begin);
      CAPTURE(rest);
      RawConnection connection(echo.server->port());
      connection.send(fmt::format("{} HTTP/1.1\r\nHost: localhost\r\n{}", begin, rest));
      CHECK(connection.read_header().starts_with("HTTP/1.1 400"));  // Before this side has said that no more comes.
    }
}

TEST_CASE("what others have added to the page's address is passed over, and nothing beside the page is found by it") {
  Echo echo;
  for (const char* path : {"/?utm_source=mail", "/?", "/?a=b&c=/../etc/passwd", "/page.js?v=2", "/??"})
    CHECK_MESSAGE(echo.get(path).starts_with("HTTP/1.1 200"), path);
  for (const char* path : {"/page?.js", "/x?/", "//?", "?/", "/%3Futm"})
    CHECK_MESSAGE(!echo.get(path).starts_with("HTTP/1.1 200"), path);
}

TEST_CASE("the page is served on both of this machine's own addresses, whichever a browser takes for localhost") {
  auto probe = ListeningSocket::open(0).value().copy().value();
  const bool has_ipv6 = probe.ipv6 >= 0;
  probe.close();
  if (!has_ipv6) return;
  Echo echo;
  RawConnection connection(echo.server->port(), 0, true);
  connection.send("GET / HTTP/1.1\r\nHost: [::1]\r\n\r\n");
  connection.send_no_more();
  CHECK(connection.read_all().find("<p>page") != std::string::npos);
}

TEST_CASE("a port that is taken is an error that names it") {
  Echo echo;
  const auto second = WebServer::start({.port = echo.server->port()}, {});
  REQUIRE(!second.has_value());
  CHECK(second.error().where.find(std::to_string(echo.server->port())) != std::string::npos);
}

}  // namespace septet::page
