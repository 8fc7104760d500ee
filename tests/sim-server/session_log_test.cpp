#include "sim-server/drive/session_log.hpp"

#include <memory>
#include <string>

#include <doctest/doctest.h>

#include "tests/sim-server/shipped_drive.hpp"
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

}  // namespace septet::server
