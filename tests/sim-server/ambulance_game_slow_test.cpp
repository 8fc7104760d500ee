// The game as the product plays it: it ends as its rules say, is the same again with the same driving, and simulated
// drivers can play it.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "sim-server/drive/driver_seat.hpp"
#include "sim-server/drive/live_drive.hpp"
#include "sim-server/drive/session_log.hpp"
#include "tests/sim-server/shipped_drive.hpp"
#include "tests/temporary_folder.hpp"

namespace septet::server {
namespace {

struct PlayedGame {
  GameStanding standing;
  logging::DriveEnd end = logging::DriveEnd::failed;
  std::uint64_t state_hash = 0;
  std::size_t least_vehicles = 1000, most_vehicles = 0;
  std::set<int> lanes;  ///< Lanes of the driver.
  std::vector<std::string> events;
};

/// `driver` empty: the controls are held as they are.
PlayedGame play(const std::string& driver, std::uint64_t seed, double seconds, const DriverInput& held = {}) {
  const LoadedDrive loaded = shipped_drive("motorway-ambulance", "seven-screens", seed);
  auto seat = driver.empty() ? Expected<DriverSeat>(DriverSeat{})
                             : open_driver_seat(rig::Car{.driver = driver}, seed, loaded.model);
  REQUIRE(seat.has_value());
  auto drive = LiveDrive::start(loaded.model, traffic::own_traffic(loaded.model->roads, seed), std::move(*seat));
  REQUIRE(drive.has_value());
  PlayedGame played;
  const TemporaryFolder folder;
  auto log = SessionLog::create(loaded, {.out = folder.path(), .log_samples_only = true, .no_screens = true});
  REQUIRE(log.has_value());
  log->watch({}, [&](const logging::Event& event) {
    if (event.kind == "game") played.events.push_back(event.detail);
  });
  (*drive)->log_to(*log);
  while ((*drive)->newest().simulated_time_s < seconds) {
    const auto next = (*drive)->next(driver.empty() ? std::optional(held) : std::nullopt);
    if (!next || !*next) break;
    const Snapshot& now = (*drive)->newest();
    played.least_vehicles = std::min(played.least_vehicles, now.participants.size());
    played.most_vehicles = std::max(played.most_vehicles, now.participants.size());
    if (now.driver_car.lane != 0) played.lanes.insert(now.driver_car.lane);
    REQUIRE(now.game.has_value());
    played.standing = *now.game;
    played.state_hash = now.state_hash;
  }
  played.end = (*drive)->end();
  return played;
}

}  // namespace

TEST_CASE("who lets go of the wheel touches somebody, and the game is over") {
  const PlayedGame played = play("", 1, 60.0);
  CHECK(played.standing.end == GameEnd::crash);
  CHECK(played.end == logging::DriveEnd::game_over);
  CHECK(played.events.back().find("state=over why=crash") == 0);
}

TEST_CASE("who brakes to a halt loses the ambulance, and the game is over") {
  const PlayedGame played = play("", 1, 120.0, {.brake = 0.25});
  CHECK(played.standing.end == GameEnd::lost);
  CHECK(played.end == logging::DriveEnd::game_over);
  CHECK(played.standing.leader_m > 250.0);
  CHECK(played.standing.away_s >= 10.0);
  REQUIRE(played.events.size() >= 2);
  CHECK(played.events.front() == "state=begins level=1");
  CHECK(played.events.back().find("state=over why=lost") == 0);
}

TEST_CASE("a simulated driver plays through lanes and levels, and plays the same game again") {
  const PlayedGame played = play("experienced", 3, 100.0);
  MESSAGE("level " << played.standing.level << ", " << played.standing.points << " points after "
                   << played.standing.survived_s << " s, lanes " << played.lanes.size() << ", vehicles "
                   << played.least_vehicles << " to " << played.most_vehicles);
  CHECK(played.standing.end == GameEnd::none);
  CHECK(played.standing.level == 3);
  CHECK(played.standing.points > 500.0);
  CHECK(played.lanes.size() >= 3);
  CHECK(played.most_vehicles >= played.least_vehicles + 30);
  const PlayedGame again = play("experienced", 3, 100.0);
  CHECK(again.standing == played.standing);
  CHECK(again.state_hash == played.state_hash);
}

TEST_CASE("other seeds are other games") {
  CHECK(play("plain", 4, 12.0).state_hash != play("plain", 5, 12.0).state_hash);
}

}  // namespace septet::server
