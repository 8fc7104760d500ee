// Crashes as the log has them are those of its snapshots: the Python reader reckons them anew.

#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "sim-server/drive/who_is_who.hpp"
#include "tests/engine/simulation/shipped_drives/staged_crash.hpp"
#include "tests/logging/session_fixture.hpp"

namespace septet::simulation {
namespace {

/// Drives a staged crash to its end, and logs it.
void log_crash(const std::string& name, const std::filesystem::path& session) {
  StagedCrash crash(name);
  logging::SessionInfo info = logging::example_info();
  info.other.merge(server::who_is_who(*crash.loaded.model));
  auto writer = logging::SessionWriter::create(session, info);
  REQUIRE_MESSAGE(writer.has_value(), why_not(writer));
  writer->record(logging::taken(crash.now));
  std::size_t told = 0;
  while (crash.state.tick < 1100) {
    crash.step();
    for (; told < crash.events.size(); ++told) {
      const Event& event = crash.events[told];
      writer->record(
          logging::Event{crash.now.tick, crash.now.simulated_time_s, event.kind, event.participant, event.detail});
    }
    writer->record(logging::taken(crash.now));
  }
  REQUIRE(writer->finish().has_value());
}

}  // namespace

TEST_CASE("figures of crashes, of the driver's car and of two others, follow from the snapshots within 1 %") {
  const TemporaryFolder folder;
  for (const char* name : {"side", "walker"}) {
    CAPTURE(std::string(name));
    const auto session = folder.path() / (std::string(name) + ".sqlite");
    log_crash(name, session);
    CHECK(std::system(fmt::format("/usr/bin/python3 -B '{}/tests/logging/crash_check.py' '{}' {}", source_folder(),
                                  session.string(), name)
                          .c_str()) == 0);
  }
}

}  // namespace septet::simulation
