#include "sim-client/film/time_limit.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

#include <doctest/doctest.h>

#include "tests/relative.hpp"

namespace septet::film {
namespace {

/// Machines whose times are exactly those of the model.
struct Exact {
  FilmTimes times;
  std::size_t frames;
  double spent_s = 0.0;
  std::vector<std::uint32_t> tried{};
  Expected<double> operator()(std::size_t every, std::uint32_t samples) {
    tried.push_back(samples);
    const double took_s = times.of((frames + every - 1) / every, samples);
    spent_s += took_s;
    return took_s;
  }
};

}  // namespace

TEST_CASE("a film with the samples that are chosen is made within its time, and uses most of it") {
  for (const FilmTimes times : {FilmTimes{1.5, 0.3, 0.02}, FilmTimes{0.0, 0.0, 0.5}, FilmTimes{20.0, 4.0, 1e-3}})
    for (const std::size_t frames : {1u, 2u, 5u, 250u, 10'000u})
      for (const double limit_s : {3600.0, 86'400.0}) {
        CAPTURE(times.start_s);
        CAPTURE(frames);
        CAPTURE(limit_s);
        Exact machines{times, frames};
        const auto choice = choose_samples(frames, limit_s, 8192, std::ref(machines));
        const bool possible = machines.spent_s + times.of(frames, 1.0) < 0.9 * limit_s;
        REQUIRE(choice.has_value() == possible);
        if (!choice) continue;
        CHECK(choice->tried_s == doctest::Approx(machines.spent_s));
        CHECK(machines.spent_s < 0.15 * limit_s);
        const double took_s = times.of(frames, choice->samples);
        CHECK(choice->foretold_s == relative(took_s, 0.02));
        CHECK(machines.spent_s + took_s <= limit_s);
        if (choice->samples < 8192)
          CHECK(machines.spent_s + took_s + static_cast<double>(frames) * times.sample_s > 0.88 * limit_s);
      }
}

TEST_CASE("where not even one sample has time it is told how long that takes") {
  Exact machines{{1.0, 1.0, 1.0}, 1000};
  const auto choice = choose_samples(1000, 60.0, 64, std::ref(machines));
  REQUIRE_FALSE(choice.has_value());
  CHECK(choice.error().what.find("2001 s") != std::string::npos);
  CHECK(machines.tried.size() <= 4);
}

TEST_CASE("a trial that fails is the end and its reason is told") {
  const auto choice = choose_samples(10, 60.0, 64, [](std::size_t, std::uint32_t) -> Expected<double> {
    return failure("no room", "out", "make room");
  });
  REQUIRE_FALSE(choice.has_value());
  CHECK(choice.error().what == "no room");
}

}  // namespace septet::film
