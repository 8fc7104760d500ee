#include "sim-client/film/accident/subtitles.hpp"

#include <sstream>
#include <string>

#include <doctest/doctest.h>

#include "engine/core/printable.hpp"

namespace septet::film {
namespace {

double seconds_of(const std::string& text) {
  return std::stod(text.substr(0, 2)) * 3600.0 + std::stod(text.substr(3, 2)) * 60.0 + std::stod(text.substr(6, 2)) +
         std::stod(text.substr(9, 3)) / 1000.0;
}

}  // namespace

TEST_CASE("subtitles have two lines of 42 characters at most and 17 a second and never overlap") {
  std::vector<Spoken> spoken;
  double at_s = 0.0;
  for (const double lasts_s : {8.0, 0.5, 2.0, 3.5, 30.0}) {
    spoken.push_back({at_s, at_s + lasts_s,
                      "What the driver of the saloon has before them, é" + std::string(spoken.size() * 30, 'a') +
                          " and after that some more words that nobody could read in so short a time"});
    at_s += lasts_s;
  }
  std::istringstream srt(subtitles(spoken));
  std::string line;
  int blocks = 0;
  double last_s = -1.0;
  while (std::getline(srt, line)) {
    CHECK(line == std::to_string(++blocks));
    REQUIRE(std::getline(srt, line));
    const double from_s = seconds_of(line), to_s = seconds_of(line.substr(17));
    CHECK(from_s >= last_s + 0.0799);
    CHECK(to_s - from_s >= 1.0);
    CHECK(to_s - from_s <= 7.0);
    last_s = to_s;
    std::size_t characters = 0, lines = 0;
    while (std::getline(srt, line) && !line.empty()) {
      const auto in_line = printable_characters(line);
      REQUIRE(in_line.has_value());
      CHECK(*in_line <= 42);
      characters += *in_line, ++lines;
    }
    CHECK(lines >= 1);
    CHECK(lines <= 2);
    CHECK(static_cast<double>(characters) <= 17.0 * (to_s - from_s));
  }
  CHECK(blocks == 4);  // Half a second is too short for one.
}

}  // namespace septet::film
