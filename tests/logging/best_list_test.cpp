// The best list of a game.

#include <fstream>
#include <string>

#include <doctest/doctest.h>

#include "logging/study/best_list.hpp"
#include "tests/temporary_folder.hpp"

namespace septet::logging {
namespace {

BestListEntry played(const std::string& participant, double points, const std::string& game = "motorway-ambulance") {
  return {game, participant, points, 60.0, 2, "lost", "2026-11-21T09:30:00Z"};
}

}  // namespace

TEST_CASE("a best list has the best of each game first, and tells the place of who comes in") {
  const TemporaryFolder folder;
  const auto path = folder / "best-list.json";
  CHECK(read_best_list(path)->empty());
  CHECK(*enter_best_list(path, played("P01", 500.0)) == 1);
  CHECK(*enter_best_list(path, played("P02", 900.0)) == 1);
  CHECK(*enter_best_list(path, played("P03", 700.0)) == 2);
  CHECK(*enter_best_list(path, played("P03", 9000.0, "other")) == 1);
  CHECK(*enter_best_list(path, played("", 700.0)) == 3);  // An earlier equal stays before.
  const auto list = read_best_list(path);
  REQUIRE(list.has_value());
  REQUIRE(list->size() == 5);
  CHECK((*list)[0] == played("P02", 900.0));
  CHECK((*list)[1].participant == "P03");
  CHECK((*list)[4].game == "other");
}

TEST_CASE("a best list does not grow beyond its length, and forgets who asks for it") {
  const TemporaryFolder folder;
  const auto path = folder / "best-list.json";
  for (std::size_t i = 0; i < longest_best_list + 3; ++i)
    REQUIRE(enter_best_list(path, played("P" + std::to_string(i % 10), static_cast<double>(i))).has_value());
  CHECK(read_best_list(path)->size() == longest_best_list);
  CHECK(read_best_list(path)->back().points == doctest::Approx(3.0));
  CHECK(*forget_in_best_list(path, "P7") == 20);
  CHECK(*forget_in_best_list(path, "P7") == 0);
  CHECK(read_best_list(path)->size() == longest_best_list - 20);
}

TEST_CASE("a file that is no best list is told and never written over") {
  const TemporaryFolder folder;
  for (const std::string text : {"my notes", "{}", "[1]", R"({"best_list": [3]})", R"({"best_list": [{"game": "a"}]})",
                                 R"({"best_list": {"game": 1}})",
                                 R"({"best_list": [{"game": "a", "participant": "", "end": "", "started_utc": "", )"
                                 R"("points": "many", "survived_s": 1.0, "level": 1}]})"}) {
    const auto path = folder / "best-list.json";
    std::ofstream(path) << text;
    CHECK_FALSE(enter_best_list(path, played("P01", 1.0)).has_value());
    CHECK_FALSE(forget_in_best_list(path, "P01").has_value());
    std::string kept;
    std::getline(std::ifstream(path) >> std::ws, kept);
    CHECK(kept == text);
  }
}

}  // namespace septet::logging
