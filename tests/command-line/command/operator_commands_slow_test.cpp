/// An operator's changes during a drive are part of the drive: logged, and repeated when it is run again.

#include <algorithm>

#include <doctest/doctest.h>

#include "command-line/command/replay_command.hpp"
#include "engine/simulation/operator_command.hpp"
#include "engine/world/call.hpp"
#include "logging/session/session_reader.hpp"
#include "logging/session/sqlite_database.hpp"
#include "sim-server/drive/driver_seat.hpp"
#include "sim-server/drive/live_drive.hpp"
#include "sim-server/drive/session_log.hpp"
#include "tests/sim-server/shipped_drive.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/why_not.hpp"

namespace septet::server {
namespace {

using Commands = std::vector<std::pair<Tick, std::string>>;  ///< After this tick.

const std::string place_ahead = "PLACE", put_back = "PUT", solid_ahead = "SOLID", brake = "BRAKE", let_go = "LET GO";

/// A cone 60 m ahead of the driver's car.
std::string placed_before(const LiveDrive& live) {
  const auto& car = live.newest().participants.front().world_from_vehicle;
  const Vec3 at = car * Vec3(60.0, 0.0, 0.0);
  return fmt::format("place x_m={:.2f} y_m={:.2f} part=traffic-cone", at.x, at.y);
}

/// A wall across the way, 60 m ahead of the driver's car.
std::string solid_before(const LiveDrive& live) {
  const auto& car = live.newest().participants.front().world_from_vehicle;
  const Vec3 at = car * Vec3(60.0, 0.0, 0.0);
  return simulation::text_of(simulation::StandSolid{.x_m = at.x,
                                                    .y_m = at.y,
                                                    .z_m = at.z,
                                                    .heading_rad = heading_rad(car.orientation),
                                                    .length_m = 0.3,
                                                    .width_m = 12.0,
                                                    .height_m = 2.0});
}

/// To a free place behind the car, at rest.
std::string put_before(const LiveDrive& live) {
  const auto& all = live.newest().participants;
  const auto& car = all.front().world_from_vehicle;
  for (double behind_m = 20.0; behind_m < 400.0; behind_m += 5.0) {
    const Vec3 at = car * Vec3(-behind_m, 0.0, 0.0);
    const bool is_free = std::ranges::none_of(
        all, [&](const Participant& other) { return glm::distance(other.world_from_vehicle.position_m, at) < 20.0; });
    if (is_free) return fmt::format("put x_m={:.2f} y_m={:.2f} heading_rad=0 speed_mps=0", at.x, at.y);
  }
  return "";
}

/// Drives and logs; returns the last state hash.
std::uint64_t drive_with(const Commands& commands, Tick ticks, const std::filesystem::path& out) {
  const LoadedDrive loaded = shipped_drive("behind-ambulance", "seven-screens");
  auto seat = open_driver_seat(loaded.rig.car, 1, loaded.model);
  REQUIRE(seat.has_value());
  auto live = LiveDrive::start(loaded.model, traffic::own_traffic(loaded.model->roads, 1), std::move(*seat));
  REQUIRE(live.has_value());
  auto log = SessionLog::create(loaded, {.out = out, .lockstep = true});
  REQUIRE(log.has_value());
  (*live)->log_to(*log);
  for (Tick tick = 0; tick < ticks; ++tick) {
    for (const auto& [after, text] : commands) {
      if (after != tick) continue;
      if (text == brake || text == let_go) {
        (*live)->brake(text == brake ? 1.0 : 0.0);
        continue;
      }
      const auto command = simulation::parse_operator_command(text == place_ahead   ? placed_before(**live)
                                                              : text == put_back    ? put_before(**live)
                                                              : text == solid_ahead ? solid_before(**live)
                                                                                    : text);
      REQUIRE(command.has_value());
      const auto done = (*live)->command(*command);
      REQUIRE_MESSAGE(done.has_value(), why_not(done));
    }
    REQUIRE((*live)->next(std::nullopt).has_value());
  }
  REQUIRE(log->finish(log->outcome({}, {})).has_value());
  return (*live)->newest().state_hash;
}

/// From its start, and from the state that was kept at 10 s.
void require_verified(const std::filesystem::path& session) {
  for (const double from_s : {0.0, 10.2}) {
    const auto verified = run_verify(session, from_s);
    REQUIRE_MESSAGE(verified.has_value(), why_not(verified));
  }
}

}  // namespace

TEST_CASE("a drive with an operator's commands is verified from its start and from a state kept between them") {
  const septet::TemporaryFolder plain, changed;
  const Commands commands{
      {0, "conditions friction_scale=0.7"},
      {60, "conditions rain_mm_per_h=12.3 road_wetness=0.6 temperature_k=280.15"},
      {61, "trigger element=emergency drive::through the traffic::ambulance::speed::goes on"},
      {300, "traffic vehicles=31"},
      {300, "hide entity=ambulance"},
      {420, "show entity=ambulance"},
      {421, "PLACE"},
      {424, "PLACE"},
      {660, "remove thing=2"},
      {1200, "conditions road_wetness=0.1"},  // The log keeps the state of this tick as it was before.
      {1200, "conditions snow_cover=0.3"},
  };
  const auto hash = drive_with(commands, 1260, changed.path());
  CHECK(hash != drive_with({}, 1260, plain.path()));
  const auto session = changed.path() / "session.sqlite";
  require_verified(session);
  const auto reader = logging::SessionReader::open(session);
  REQUIRE(reader.has_value());
  const auto events = reader->events();
  REQUIRE(events.has_value());
  std::vector<std::string> logged;
  for (const auto& event : *events)
    if (event.kind == operator_command_event) logged.push_back(fmt::format("{} {}", event.tick, event.detail));
  REQUIRE(logged.size() == commands.size());
  for (std::size_t i = 0; i < commands.size(); ++i)
    CHECK(logged[i].starts_with(fmt::format("{} {}", commands[i].first + 1,
                                            commands[i].second == place_ahead ? "place x_m=" : commands[i].second)));
}

TEST_CASE("a call changes no hash, is told as an event of its tick, is verified, and one that was altered is found") {
  const septet::TemporaryFolder plain, called;
  const auto hash = drive_with({{60, "call name=lift node=stimuli/barrier seconds=3 by=lab"}}, 90, called.path());
  CHECK(hash == drive_with({}, 90, plain.path()));
  const auto session = called.path() / "session.sqlite";
  const auto verified = run_verify(session, 0.0);
  REQUIRE_MESSAGE(verified.has_value(), why_not(verified));
  const auto events = logging::SessionReader::open(session)->events();
  REQUIRE(events.has_value());
  const auto told = std::ranges::find(*events, call_event, &logging::Event::kind);
  REQUIRE(told != events->end());
  CHECK(told->tick == 61);
  CHECK(told->detail == "name=lift node=stimuli/barrier seconds=3 by=lab");
  {
    auto database = logging::Database::open(session, logging::OpenMode::change);
    REQUIRE(database.has_value());
    auto statement = database->prepare("UPDATE events SET detail = replace(detail, 'seconds=3', 'seconds=4')");
    REQUIRE(statement.has_value());
    REQUIRE(statement->run().has_value());
  }
  const auto altered = run_verify(session, 0.0);
  REQUIRE_FALSE(altered.has_value());
  CHECK(altered.error().what.find("calls are not those that were made") != std::string::npos);
}

TEST_CASE("a drive with a solid is verified from its start and from a state kept while it stands") {
  const septet::TemporaryFolder plain, changed;
  const Commands commands{{1000, solid_ahead}, {1230, "clear solid=0"}};
  const auto hash = drive_with(commands, 1260, changed.path());
  CHECK(hash != drive_with({}, 1260, plain.path()));
  const auto session = changed.path() / "session.sqlite";
  require_verified(session);
}

TEST_CASE("a drive in which a tree is gone for a while is verified from its start and from a state kept meanwhile") {
  const septet::TemporaryFolder plain, hidden, changed;
  const LoadedDrive loaded = shipped_drive("behind-ambulance", "seven-screens");
  const auto listed = loaded.model->obstacles->listed();
  const auto tree = std::ranges::find(listed, ObstacleKind::tree, &Obstacle::kind);
  REQUIRE(tree != listed.end());
  simulation::ShowStanding show{tree->from_m.x, tree->from_m.y, false, "tree/of a test"};
  const std::string gone = simulation::text_of(show);
  show.shown = true;
  const Commands commands{{1000, gone}, {1230, simulation::text_of(show)}};
  const auto hash = drive_with({}, 1260, plain.path());
  CHECK(drive_with({commands.front()}, 1260, hidden.path()) != hash);
  CHECK(drive_with(commands, 1260, changed.path()) == hash);  // Nobody was near it.
  require_verified(changed.path() / "session.sqlite");
}

TEST_CASE(
    "a drive with faults, the instructor's brake and a car that was put back is verified from its start and from a "
    "kept state") {
  const septet::TemporaryFolder plain, changed;
  const Commands commands{{30, "fault what=tyre_front_left"},
                          {31, "fault what=anti_lock"},
                          {32, "fault what=misfire"},
                          {33, "fault what=lamp_low_beam"},
                          {600, brake},
                          {690, let_go},
                          {900, put_back},
                          {1190, "repair what=misfire"},
                          {1210, brake},
                          {1230, let_go},
                          {1240, "fault what=tyre_rear_right"}};
  const auto hash = drive_with(commands, 1300, changed.path());
  CHECK(hash != drive_with({}, 1300, plain.path()));
  const auto session = changed.path() / "session.sqlite";
  require_verified(session);
  const auto reader = logging::SessionReader::open(session);
  REQUIRE(reader.has_value());
  const auto inputs = reader->inputs();
  REQUIRE(inputs.has_value());
  for (const auto& input : *inputs)
    if (input.tick > 600 && input.tick <= 690) {
      CHECK(input.input.brake == 1.0);
      CHECK(input.input.accelerator == 0.0);
    }
  const auto samples = reader->samples();
  REQUIRE(samples.has_value());
  for (const auto& sample : *samples) {
    if (sample.tick > 40) CHECK_FALSE(sample.lamps.has(Lamp::low_beam));
    if (sample.tick > 901 && sample.tick < 912) CHECK(sample.speed_mps < 2.0);
  }
}

}  // namespace septet::server
