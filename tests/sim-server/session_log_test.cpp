#include "sim-server/drive/session_log.hpp"

#include <memory>
#include <string>

#include <doctest/doctest.h>

#include "logging/session/session_reader.hpp"
#include "logging/study/measures/crashes.hpp"
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
  CHECK(logging::crash_text(crashes.front()).ends_with("; the drive ended before its impact was over"));
}

}  // namespace septet::server
