#include "sim-server/drive/session_log.hpp"

#include <memory>
#include <string>

#include <doctest/doctest.h>

#include "engine/world/solid.hpp"
#include "logging/session/participants.hpp"
#include "logging/session/session_reader.hpp"
#include "logging/study/measures/crashes.hpp"
#include "logging/study/report/crash_section.hpp"
#include "logging/study/report/told_event.hpp"
#include "tests/sim-server/shipped_drive.hpp"
#include "tests/sim-server/simulated_drive.hpp"
#include "tests/temporary_folder.hpp"

namespace septet::server {

TEST_CASE("the last line of a drive and its outcome tell how many numbers went bad") {
  const LoadedDrive drive = shipped_drive("behind-ambulance", "desktop");
  const septet::TemporaryFolder folder;
  auto log = SessionLog::create(drive, {.out = folder.path(), .lockstep = true});
  REQUIRE(log.has_value());
  Snapshot snapshot;
  snapshot.diagnostics.bad_numbers = 3;
  log->record_tick(std::make_shared<const TakenSnapshot>(snapshot), {});
  CHECK(log->ending({}).find("3 numbers went bad") != std::string::npos);
  CHECK(log->outcome({}, {}).bad_numbers == 3);
}

TEST_CASE(
    "a contact with a solid has the name in the log that the solid had then, and keeps it in the finished session") {
  const LoadedDrive drive = shipped_drive("behind-ambulance", "desktop");
  const septet::TemporaryFolder folder;
  auto log = SessionLog::create(drive, {.out = folder.path(), .lockstep = true});
  REQUIRE(log.has_value());
  constexpr ParticipantId third = first_solid_participant + 3;
  CrashRecord crash;
  crash.first = 1, crash.second = third, crash.closing_speed_mps = 5.0;
  const auto meet = [&](Tick tick) {
    Snapshot snapshot;
    snapshot.tick = tick;
    const std::vector<simulation::Event> events{
        {"collision", third, "closing_speed_mps=5.00 by=driver"},
        {"crash_of_others", 7, fmt::format("with={} closing_speed_mps=5.00 by=7", third)},
        {"crash", 1, text_of(crash)},
        {"collision", 7, "closing_speed_mps=5.00 by=other"}};
    log->record_tick(std::make_shared<const TakenSnapshot>(snapshot), events);
  };
  meet(1);
  log->record_command(2, simulation::StandSolid{.solid = 3, .name = "stimuli/brick wall"});
  meet(2);
  log->record_command(3, simulation::StandSolid{.solid = 3, .name = "stimuli/gate"});
  meet(3);
  REQUIRE(log->finish(log->outcome({}, {})).has_value());

  const auto session = logging::SessionReader::open(folder / "session.sqlite");
  REQUIRE(session.has_value());
  const auto events = session->events();
  REQUIRE(events.has_value());
  std::vector<std::string> says;
  for (const logging::ToldEvent& told : logging::tell_events(*events, {}))
    if (told.row->title == "collisions") says.push_back(told.says);
  REQUIRE(says.size() == 12);
  const std::string number = std::to_string(third), speed = " at a closing speed of 18 km/h";
  CHECK(says[0] == "collision with participant " + number + speed);
  CHECK(says[1] == "participant 7 ran into participant " + number + speed);
  CHECK(says[2] == "crash: participants 1 and " + number + " met at 18 km/h");
  CHECK(says[4] == "collision with stimuli/brick wall" + speed);
  CHECK(says[5] == "participant 7 ran into stimuli/brick wall" + speed);
  CHECK(says[6] == "crash: participant 1 and stimuli/brick wall met at 18 km/h");
  CHECK(says[7] == "collision with participant 7" + speed + ", who ran into the driver's car");
  CHECK(says[8] == "collision with stimuli/gate" + speed);
  const auto names = logging::participant_names(*session);
  REQUIRE(names.has_value());
  CHECK(names->at(third) == "stimuli/gate");
  const auto crashes = logging::find_crashes(*events);
  REQUIRE(crashes.size() == 3);
  CHECK(logging::crash_section(crashes, 120.0, *names).find("1 ego and stimuli/brick wall") != std::string::npos);
}

TEST_CASE("a drive that ends in the middle of a crash has its record as far as it is, marked as unfinished") {
  const LoadedDrive drive = shipped_drive("crossing-crash", "desktop");
  const septet::TemporaryFolder folder;
  const auto live = simulated_drive(drive, "plain", drive.model->seed);
  auto log = SessionLog::create(drive, {.out = folder.path(), .lockstep = true});
  REQUIRE(log.has_value());
  live->log_to(*log);
  const auto is_pushed = [&] {
    const auto& crashes = live->state().open_crashes;
    return !crashes.empty() && crashes.front().record.pulse_ns.size() > 2;
  };
  while (!is_pushed()) {
    REQUIRE(live->state().tick < 1800);
    REQUIRE(live->next({}).has_value());
  }
  live->log_unfinished();
  REQUIRE(log->finish(log->outcome({.end = logging::DriveEnd::time_over}, {})).has_value());
  const auto session = logging::SessionReader::open(folder.path() / "session.sqlite");
  REQUIRE(session.has_value());
  const auto events = session->events();
  REQUIRE(events.has_value());
  const auto crashes = logging::find_crashes(*events);
  REQUIRE(crashes.size() == 1);
  CHECK(crashes.front().is_unfinished);
  CHECK(crashes.front().of_first.delta_v_mps.has_value());
  CHECK(logging::crash_text(crashes.front(), {}).ends_with("; the drive ended before its impact was over"));
}

}  // namespace septet::server
