#include <fstream>

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

}  // namespace

TEST_CASE("a film begun in the middle shows frame by frame what the whole film shows though somebody has vanished") {
  const TemporaryFolder folder;
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
  FilmOptions options{.session = folder / "session.sqlite",
                      .shots = folder / "shots.toml",
                      .out = folder / "whole",
                      .width_px = 64,
                      .height_px = 48,
                      .software = true};
  const auto goes_on = [](const FilmMade&) { return true; };
  const auto whole = make_film(options, goes_on);
  REQUIRE_MESSAGE(whole.has_value(), (whole ? "" : describe(whole.error())));
  REQUIRE(whole->frames == 25);
  options.out = folder / "end";
  options.from_s = 0.6;
  const auto end = make_film(options, goes_on);
  REQUIRE_MESSAGE(end.has_value(), (end ? "" : describe(end.error())));
  CHECK(end->frames == 10);
  for (const fs::directory_entry& picture : fs::directory_iterator(folder / "end")) {
    const fs::path name = picture.path().filename();
    CAPTURE(name);
    CHECK(bytes_of(picture.path()) == bytes_of(folder / "whole" / name));
  }
}

}  // namespace septet::film
