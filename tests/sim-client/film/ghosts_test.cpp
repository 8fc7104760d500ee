#include "sim-client/film/ghosts.hpp"

#include <filesystem>

#include <doctest/doctest.h>

#include "program/command_line.hpp"
#include "sim-client/film/film_arguments.hpp"
#include "tests/logging/session_fixture.hpp"
#include "tests/relative.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/why_not.hpp"

namespace septet::film {
namespace {

constexpr Tick parts = 60, last = 120;  // From `parts` on the driver of the other session is 2 m higher.

Snapshot other_snapshot(Tick tick) {
  Snapshot snapshot = logging::drive_snapshot(tick);
  if (tick >= parts) snapshot.participants.front().world_from_vehicle.position_m.z += 2.0;
  return snapshot;
}

std::filesystem::path write_other(const TemporaryFolder& folder, logging::SessionInfo info = logging::example_info()) {
  const auto path = folder / "other.sqlite";
  auto writer = logging::SessionWriter::create(path, info, {});
  REQUIRE_MESSAGE(writer.has_value(), why_not(writer));
  for (Tick tick = 0; tick <= last; ++tick) writer->record(logging::taken(other_snapshot(tick)));
  REQUIRE(writer->finish().has_value());
  return path;
}

TEST_CASE("a ghost is shown from where two sessions part, at its own place and in its own paint") {
  const TemporaryFolder folder;
  auto ghosts = Ghosts::open({write_other(folder)}, logging::example_info());
  REQUIRE_MESSAGE(ghosts.has_value(), why_not(ghosts));
  const ParticipantId ghost = ghost_number(0, 1);
  CHECK(ghosts->drivers() == std::vector{ghost});
  for (const Tick tick : {Tick{30}, Tick{90}, Tick{110}}) {
    CAPTURE(tick);
    Snapshot world = logging::drive_snapshot(tick);
    const std::size_t own = world.participants.size();
    const auto added = ghosts->add_to(world, world.simulated_time_s);
    REQUIRE_MESSAGE(added.has_value(), why_not(added));
    const Participant* shown = find_participant(world, ghost);
    if (tick < parts) {
      CHECK(shown == nullptr);
      CHECK(world.participants.size() == own);
    } else {
      REQUIRE(shown != nullptr);
      CHECK(world.participants.size() == own + 1);
      const Vec3 own_m = find_participant(world, 1)->world_from_vehicle.position_m;
      CHECK(shown->world_from_vehicle.position_m.z - own_m.z == relative(2.0, 0.001));
      CHECK(shown->paint != find_participant(world, 1)->paint);
    }
  }
}

TEST_CASE("who is missing in the film's own session is a ghost, and an instant after the other's end has none") {
  const TemporaryFolder folder;
  auto ghosts = Ghosts::open({write_other(folder)}, logging::example_info());
  REQUIRE(ghosts.has_value());
  Snapshot alone = logging::drive_snapshot(10, 1);
  REQUIRE(ghosts->add_to(alone, alone.simulated_time_s).has_value());
  CHECK(alone.participants.size() == 5);
  ghosts->begin_shot();
  Snapshot late = logging::drive_snapshot(last + 30, 1);
  REQUIRE(ghosts->add_to(late, late.simulated_time_s).has_value());
  CHECK(late.participants.size() == 1);
}

TEST_CASE("as many sessions are ghosts as have numbers of their own below those of a scene's moving objects") {
  CHECK(most_ghost_sessions == 64);
  CHECK(ghost_number(most_ghost_sessions - 1, numbers_a_ghost_session - 1) < first_moving_object);
  FilmArguments arguments;
  CLI::App app;
  add_film_options(app, arguments);
  arguments.film.session = "session.sqlite";
  arguments.film.ghosts.assign(most_ghost_sessions, "other.sqlite");
  CHECK(settle(app, arguments).has_value());
  arguments.film.ghosts.emplace_back("one-more.sqlite");
  const auto refused = settle(app, arguments);
  REQUIRE_FALSE(refused.has_value());
  CHECK(why_not(refused).find("65 sessions") != std::string::npos);
  CHECK(why_not(refused).find("give 64 at most") != std::string::npos);
}

TEST_CASE("a session of other roads, and a file that is no session, are no ghosts") {
  const TemporaryFolder folder;
  logging::SessionInfo info = logging::example_info();
  info.files.push_back({"road", "elsewhere.xodr", "<OpenDRIVE/>"});
  const auto other = Ghosts::open({write_other(folder, info)}, logging::example_info());
  REQUIRE_FALSE(other.has_value());
  CHECK(other.error().what.find("other roads") != std::string::npos);
  CHECK_FALSE(Ghosts::open({folder / "nowhere.sqlite"}, logging::example_info()).has_value());
}

}  // namespace
}  // namespace septet::film
