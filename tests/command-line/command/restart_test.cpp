/// A drive begins at a state that an earlier drive's log kept: everybody as they were then, and a session of its own that is whole.

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "command-line/command/replay_command.hpp"
#include "logging/session/session_reader.hpp"
#include "logging/session/sqlite_database.hpp"
#include "logging/session/whole_session.hpp"
#include "sim-server/drive/kept_state.hpp"
#include "sim-server/drive/live_drive.hpp"
#include "sim-server/drive/session_log.hpp"
#include "tests/sim-server/shipped_drive.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/why_not.hpp"

namespace septet::server {
namespace {

constexpr Tick kept_tick = 1200, last_tick = 1260;

/// The keys that are held at a tick: a function of it, so that two drives have the same.
DriverInput keys_at(Tick tick) { return {.accelerator = tick < 700 ? 0.5 : 0.2, .brake = tick > 1230 ? 0.3 : 0.0}; }

std::unique_ptr<traffic::TrafficEngine> traffic_of(const LoadedDrive& loaded) {
  return traffic::own_traffic(loaded.model->roads, loaded.model->seed);
}

/// Drives by keys to the last tick and logs; the state hashes of the ticks that were driven.
std::vector<std::uint64_t> drive_from(const LoadedDrive& loaded, simulation::State state,
                                      const std::filesystem::path& out) {
  const auto live = LiveDrive::start(loaded.model, std::move(state), {});
  auto log = SessionLog::create(loaded, {.out = out, .lockstep = true}, live->state().tick);
  REQUIRE(log.has_value());
  live->log_to(*log);
  std::vector<std::uint64_t> hashes;
  while (live->state().tick < last_tick) {
    REQUIRE(live->next(keys_at(live->state().tick + 1)).has_value());
    hashes.push_back(live->newest().state_hash);
  }
  REQUIRE(log->finish(log->outcome({}, {})).has_value());
  return hashes;
}

/// A drive from its start, whose log kept a state.
struct EarlierDrive {
  TemporaryFolder folder;
  LoadedDrive loaded = shipped_drive("first-lesson", "desktop");
  std::vector<std::uint64_t> hashes =
      drive_from(loaded, simulation::initial_state(*loaded.model, traffic_of(loaded)).value(), folder.path());
  std::filesystem::path session = folder / "session.sqlite";
};

Expected<simulation::State> state_of(const std::filesystem::path& file, const LoadedDrive& loaded, double until_s) {
  const auto session = logging::SessionReader::open(file);
  REQUIRE(session.has_value());
  return kept_state(*session, *loaded.model, until_s, traffic_of(loaded));
}

/// Ticks and texts of the events that tell another limit.
std::vector<std::pair<Tick, std::string>> limits_noted(const logging::SessionReader& session) {
  const auto events = session.events();
  REQUIRE(events.has_value());
  std::vector<std::pair<Tick, std::string>> noted;
  for (const auto& event : *events)
    if (event.kind == "speed_limit") noted.emplace_back(event.tick, event.detail);
  return noted;
}

void change(const std::filesystem::path& session, const std::string& sql) {
  auto database = logging::Database::open(session, logging::OpenMode::change);
  REQUIRE(database.has_value());
  auto statement = database->prepare(sql);
  REQUIRE(statement.has_value());
  REQUIRE(statement->run().has_value());
}

}  // namespace

TEST_CASE("a drive that begins at a kept state goes on as the earlier one did, and its session is whole and verified") {
  const EarlierDrive earlier;
  auto state = state_of(earlier.session, earlier.loaded, 10.9);
  REQUIRE_MESSAGE(state.has_value(), why_not(state));
  REQUIRE(state->tick == kept_tick);
  const TemporaryFolder folder;
  const auto hashes = drive_from(earlier.loaded, std::move(*state), folder.path());
  REQUIRE(hashes.size() == last_tick - kept_tick);
  CHECK(std::ranges::equal(hashes, std::vector(earlier.hashes.begin() + kept_tick, earlier.hashes.end())));

  const auto session = folder / "session.sqlite";
  const auto reader = logging::SessionReader::open(session);
  REQUIRE(reader.has_value());
  const auto whole = logging::read_whole(*reader, {});
  REQUIRE_MESSAGE(whole.has_value(), why_not(whole));
  CHECK(whole->snapshots == last_tick - kept_tick + 1);
  for (const double from_s : {0.0, 10.2}) {
    const auto verified = run_verify(session, from_s);
    CHECK_MESSAGE(verified.has_value(), why_not(verified));
  }
  // The limit was posted before: marks need it.
  const auto noted = limits_noted(*reader), before = limits_noted(*logging::SessionReader::open(earlier.session));
  REQUIRE_FALSE(noted.empty());
  CHECK(noted.front().first == kept_tick + 1);
  const auto in_force = std::ranges::lower_bound(before, kept_tick + 1, {}, &std::pair<Tick, std::string>::first);
  REQUIRE(in_force != before.begin());
  CHECK(noted.front().second == std::prev(in_force)->second);

  // The session holds its first state too, so the drive can begin there again.
  const auto again = state_of(session, earlier.loaded, 10.0);
  REQUIRE_MESSAGE(again.has_value(), why_not(again));
  CHECK(again->tick == kept_tick);
  change(session, "DELETE FROM saved_states");
  const auto without = logging::SessionReader::open(session).and_then(
      [](const logging::SessionReader& less) { return logging::read_whole(less, {}); });
  REQUIRE_FALSE(without.has_value());
  CHECK(without.error().what == "it does not hold the state that its drive began at");
}

TEST_CASE(
    "before the first kept state a drive begins at its start; a state of another drive or a forged one is refused") {
  const EarlierDrive earlier;
  const auto start = state_of(earlier.session, earlier.loaded, 9.99);
  REQUIRE_MESSAGE(start.has_value(), why_not(start));
  CHECK(start->tick == 0);
  const auto refusal = [&](const LoadedDrive& loaded) {
    const auto state = state_of(earlier.session, loaded, 20.0);
    return state ? std::string("taken") : describe(state.error());
  };
  const auto says = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
  CHECK(says(refusal(shipped_drive("first-lesson", "desktop", 2)), "in another drive"));
  CHECK(says(refusal(shipped_drive("behind-ambulance", "desktop")), "in another drive"));
  change(earlier.session, "UPDATE saved_states SET tick = 600");
  CHECK(says(refusal(earlier.loaded), "the state that was saved at tick 600 is that of tick 1200"));
  change(earlier.session, "UPDATE saved_states SET tick = 1200, data = substr(data, 1, length(data) - 9)");
  CHECK(says(refusal(earlier.loaded), "session.sqlite, tick 1200: the saved state is damaged"));
  change(earlier.session, "UPDATE saved_states SET data = zeroblob(length(data))");
  CHECK(says(refusal(earlier.loaded), "this is no saved state"));
}

TEST_CASE("a drive begins again where states are kept and a program is there that starts it again") {
  ServerOptions options{.page_handover = page::Handover{}};
  CHECK_FALSE(why_no_restart(options).has_value());
  options.log_samples_only = true;
  CHECK(why_no_restart(options) == "only samples are logged, and no state is kept");
  options.log_samples_only = false;
  options.traffic = "sumo";
  CHECK(why_no_restart(options) == "another program moves the traffic, and its state is not kept");
  CHECK(why_no_restart({}) == "this server was started by itself: only septet drive begins again");
}

}  // namespace septet::server
