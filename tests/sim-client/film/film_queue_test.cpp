#include "sim-client/film/queue/film_queue.hpp"

#include <fstream>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <doctest/doctest.h>

#include "tests/temporary_folder.hpp"

namespace septet::film {
namespace {

FilmQueue queue_in(const std::filesystem::path& folder) {
  auto queue = FilmQueue::open(folder);
  REQUIRE(queue.has_value());
  return std::move(*queue);
}

}  // namespace

TEST_CASE("a film in the queue is read as it was added, and keeps what becomes of it") {
  const TemporaryFolder folder;
  FilmQueue queue = queue_in(folder / "queue");
  CHECK(queue.films().empty());
  const auto first =
                 queue.add({.arguments = {"a b.sqlite", "--size", "64x48"}, .said_in = "/home", .out = "/film \"1\""}),
             second = queue.add({.arguments = {"c"}, .out = "/2"});
  REQUIRE((first.has_value() && second.has_value()));
  CHECK(*second == *first + 1);
  auto films = queue.films();
  REQUIRE(films.size() == 2);
  CHECK(films[0].arguments == std::vector<std::string>{"a b.sqlite", "--size", "64x48"});
  CHECK(films[0].said_in == "/home");
  CHECK(films[0].state == FilmState::waiting);
  CHECK(status_line(queue, films[0], true) == "  1  waiting      /film \"1\"");
  films[0].state = FilmState::failed, films[0].last_word = "no room", films[0].took_s = 12.5;
  REQUIRE(queue.write(films[0]).has_value());
  REQUIRE(queue.ask_to_cancel(2).has_value());
  films = queue_in(folder / "queue").films();
  REQUIRE(films.size() == 2);
  CHECK(films[0].took_s == 12.5);
  CHECK(status_line(queue, films[0], true) == "  1  failed       /film \"1\"  no room");
  CHECK(status_line(queue, films[1], true) == "  2  cancelled    /2");
}

TEST_CASE("films that are begun are being made while somebody works and interrupted else") {
  const TemporaryFolder folder;
  FilmQueue queue = queue_in(folder / "queue");
  const QueuedFilm film{.number = 3, .out = "/3", .state = FilmState::begun};
  std::ofstream(queue.log(3)) << "0 of 4 frames\n3 of 4 frames, 2 s \x1b[31mleft\n";
  CHECK(status_line(queue, film, true) == "  3  being made   /3  3 of 4 frames, 2 s \\x1b[31mleft");
  CHECK(status_line(queue, film, false).find("interrupted") != std::string::npos);
  CHECK_FALSE(queue.is_locked());
  {
    const auto lock = queue.lock();
    CHECK(lock.has_value());
    CHECK(queue.is_locked());
    CHECK_FALSE(queue.lock().has_value());
  }
  CHECK_FALSE(queue.is_locked());
}

TEST_CASE("each of many that add films at once gets a number of its own") {
  const TemporaryFolder folder;
  std::vector<std::vector<std::uint64_t>> numbers(4);
  {
    std::vector<std::jthread> threads;
    for (auto& own : numbers)
      threads.emplace_back([&folder, &own] {
        auto queue = FilmQueue::open(folder / "queue");
        for (int n = 0; queue && n < 20; ++n)
          if (const auto number = queue->add({.arguments = {"x"}, .out = "/x"})) own.push_back(*number);
      });
  }
  std::set<std::uint64_t> all;
  for (const auto& own : numbers) {
    CHECK(own.size() == 20);
    all.insert(own.begin(), own.end());
  }
  CHECK(all.size() == 80);
  CHECK(queue_in(folder / "queue").films().size() == 80);
}

TEST_CASE("what is no film of a queue is left out of it") {
  const TemporaryFolder folder;
  FilmQueue queue = queue_in(folder / "queue");
  REQUIRE(queue.add({.arguments = {"x"}, .out = "/x"}).has_value());
  int number = 10;
  for (const char* nonsense :
       {"", "{", "[]", "{}",
        R"({"arguments": [1], "said_in": "", "out": "", "state": "waiting", "last_word": "", "took_s": 0})",
        R"({"arguments": [], "said_in": "", "out": "", "state": "queer", "last_word": "", "took_s": 0})",
        R"({"arguments": [], "said_in": "", "out": "", "state": "waiting", "last_word": "", "took_s": "long"})"})
    std::ofstream(queue.path() / ("0000" + std::to_string(number++) + ".json")) << nonsense;
  for (const char* name : {"x.json", "-00001.json", "1.json", "000000.json"})
    std::ofstream(queue.path() / name) << "{}";
  std::filesystem::create_directory(queue.path() / "000099.json");
  CHECK(queue.films().size() == 1);
  CHECK(queue.nonsense() == 12);
  // The next number is beyond theirs.
  CHECK(queue.add({.arguments = {"x"}, .out = "/y"}) == 100);
}

TEST_CASE("a file with the last number does not fill the queue") {
  const TemporaryFolder folder;
  FilmQueue queue = queue_in(folder / "queue");
  REQUIRE(queue.add({.arguments = {"x"}, .out = "/x"}) == 1);
  std::ofstream(queue.path() / "999999.json") << "{}";
  std::ofstream(queue.path() / "000003.cancel");  // Request to cancel a film whose own file is gone.
  CHECK(queue.add({.arguments = {"x"}, .out = "/y"}) == 2);
  CHECK(queue.add({.arguments = {"x"}, .out = "/z"}) == 4);
  CHECK(queue.films().size() == 3);
}

}  // namespace septet::film
