#include <filesystem>
#include <fstream>
#include <iterator>

#include <doctest/doctest.h>

#include "sim-client/film/film.hpp"
#include "tests/logging/session_fixture.hpp"
#include "tests/temporary_folder.hpp"

namespace septet::film {
namespace {
namespace fs = std::filesystem;

Bytes bytes_of(const fs::path& file) {
  CAPTURE(file);
  std::ifstream stream(file, std::ios::binary);
  REQUIRE(stream.good());
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  return Bytes(begin, begin + text.size());
}

/// A second's drive on a circle, from which participant 2 vanishes between two frames of a film, and a shot through their eyes.
void write_session_and_shots(const TemporaryFolder& folder) {
  {
    auto writer = logging::must_create(folder / "session.sqlite");
    for (Tick tick = 0; tick <= 120; ++tick) {
      Snapshot snapshot = logging::drive_snapshot(tick);
      for (Participant& participant : snapshot.participants) participant.world_from_vehicle.position_m.z = 1.0;
      // Between two frames of the film, so that where he was last is not where a frame saw him.
      if (tick > 51)
        std::erase_if(snapshot.participants, [](const Participant& participant) { return participant.id == 2; });
      writer.record(logging::taken(snapshot));
    }
    REQUIRE(writer.finish().has_value());
  }
  // Seen from a place to the side of the two, which turn with the sky behind them.
  std::ofstream(folder / "shots.toml") << "[[shot]]\nfrom_s = 0\nto_s = 1\nparticipant = \"2\"\n";
}

}  // namespace

TEST_CASE("a film begun in the middle shows frame by frame what the whole film shows though somebody has vanished") {
  const TemporaryFolder folder;
  write_session_and_shots(folder);
  const FilmRenderer renderers[] = {FilmRenderer::raster, FilmRenderer::traced};
  for (const FilmRenderer renderer : renderers) {
    const std::string name = renderer == FilmRenderer::raster ? "raster" : "traced";
    CAPTURE(name);
    FilmOptions options{.session = folder / "session.sqlite",
                        .shots = folder / "shots.toml",
                        .out = folder / (name + "-whole"),
                        .width_px = 64,
                        .height_px = 48,
                        .software = true,
                        .renderer = renderer,
                        .samples = 2};
    const auto goes_on = [](const FilmMade&) { return true; };
    const auto whole = make_film(options, goes_on);
    REQUIRE_MESSAGE(whole.has_value(), (whole ? "" : describe(whole.error())));
    REQUIRE(whole->frames == 25);
    options.out = folder / (name + "-end");
    options.from_s = 0.6;
    const auto end = make_film(options, goes_on);
    REQUIRE_MESSAGE(end.has_value(), (end ? "" : describe(end.error())));
    CHECK(end->frames == 10);
    CHECK(end->bad_samples == 0);
    CHECK(std::distance(fs::directory_iterator(options.out), {}) == 10);  // The preview is gone.
    for (const fs::directory_entry& picture : fs::directory_iterator(options.out)) {
      const fs::path file = picture.path().filename();
      CAPTURE(file);
      CHECK(bytes_of(picture.path()) == bytes_of(folder / (name + "-whole") / file));
    }
  }
}

TEST_CASE("a film that is stopped while a frame is traced ends there") {
  const TemporaryFolder folder;
  write_session_and_shots(folder);
  const FilmOptions options{.session = folder / "session.sqlite",
                            .shots = folder / "shots.toml",
                            .out = folder / "film",
                            .width_px = 64,
                            .height_px = 48,
                            .renderer = FilmRenderer::traced,
                            .samples = 2};
  const auto made =
      make_film(options, [](const FilmMade& so_far) { return so_far.frames < 2 || so_far.share_of_next < 0.4; });
  REQUIRE(made.has_value());
  CHECK(made->frames == 2);
  CHECK(std::distance(fs::directory_iterator(options.out), {}) == 2);
}

}  // namespace septet::film
