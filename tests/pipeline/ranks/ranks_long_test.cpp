#include "tests/pipeline/ranks/film_of_ranks.hpp"

namespace septet::pipeline {

TEST_CASE("a film is the same bytes by 1 and 2 and 8 and 15 programs") {
  SmallFilm film(true);  // With photons.
  film.samples = "4";
  REQUIRE(film.make(film.folder / "1").code == 0);
  const auto pictures = pictures_in(film.folder / "1");
  for (const char* ranks : {"2", "8", "15"}) {
    CAPTURE(ranks);
    const Ended ended = film.make(film.folder / ranks, {"--ranks", ranks});
    INFO(ended.error);
    CHECK(ended.code == 0);
    CHECK(pictures_in(film.folder / ranks) == pictures);
  }
}

}  // namespace septet::pipeline
