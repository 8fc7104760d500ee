/// A drive of which nobody drives the car: it goes by a table.

#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "command-line/command/replay_command.hpp"
#include "command-line/command/what_if_command.hpp"
#include "engine/simulation/given_motion.hpp"
#include "logging/session/session_reader.hpp"
#include "sim-server/drive/live_drive.hpp"
#include "sim-server/drive/session_log.hpp"
#include "tests/command-line/what_if/logged_crash.hpp"
#include "tests/relative.hpp"
#include "tests/why_not.hpp"

namespace septet::server {
namespace {

/// A drive on the straight road with the van at a place, by a table.
struct MotionDrive {
  TemporaryFolder folder;
  LoadedDrive loaded;
  std::unique_ptr<LiveDrive> live;

  MotionDrive(double van_s_m, const std::string& table) {
    std::ofstream(folder / "straight.xodr") << straight_road();
    std::ofstream(folder / "crash.xosc") << crash_scenario(van_s_m);
    std::ofstream(folder / "table.csv") << table;
    auto read = load_drive(DriveFiles{.scenario = (folder / "crash.xosc").string(),
                                      .rig = source_folder() + "/rigs/desktop.toml",
                                      .motion = (folder / "table.csv").string()});
    REQUIRE_MESSAGE(read.has_value(), why_not(read));
    loaded = std::move(*read);
    auto begun = LiveDrive::start(loaded.model, traffic::own_traffic(loaded.model->roads, loaded.model->seed), {});
    REQUIRE_MESSAGE(begun.has_value(), why_not(begun));
    live = std::move(*begun);
  }
  const Participant& car() const { return live->newest().participants.front(); }
};

double heading_of(const Participant& car) {
  const Vec3 forward = car.world_from_vehicle.orientation * Vec3(1.0, 0.0, 0.0);
  return std::atan2(forward.y, forward.x);
}

/// A path that swings 1 m aside and back, at 12 to 15 m/s.
Vec2 swinging(double t_s) { return {20.0 + 12.0 * t_s + 0.25 * t_s * t_s, -1.9 + std::sin(0.8 * t_s)}; }

std::string swinging_table() {
  std::string text = "time_s,x_m,y_m\n";
  for (int i = 0; i <= 60; ++i)
    text += fmt::format("{:.1f},{:.6f},{:.6f}\n", 0.1 * i, swinging(0.1 * i).x, swinging(0.1 * i).y);
  return text;
}

/// Towards the van at 72 km/h, slowing evenly, for 4 s: 64 m.
const char* const slowing_table = "time_s,speed_kmh,speed_kmh_pm,yaw_rate_degps\n-4,72,3,0\n0,43.2,3,0\n";

}  // namespace

TEST_CASE("a car goes by its path within a millimetre and a tenth of a degree, on its springs") {
  const MotionDrive drive(400.0, swinging_table());
  double farthest_m = 0.0, most_turned_rad = 0.0;
  for (int tick = 0; tick <= 720; ++tick) {
    const double t_s = tick / 120.0;
    const Participant& car = drive.car();
    farthest_m = std::max(farthest_m, glm::distance(Vec2(car.world_from_vehicle.position_m), swinging(t_s)));
    const double along = std::atan2(0.8 * std::cos(0.8 * t_s), 12.0 + 0.5 * t_s);
    most_turned_rad = std::max(most_turned_rad, std::abs(heading_of(car) - along));
    CHECK(std::abs(car.world_from_vehicle.position_m.z) < 0.1);
    if (tick < 720) REQUIRE(drive.live->next({}).has_value());
  }
  CHECK(farthest_m < 1e-3);
  CHECK(most_turned_rad * 57.3 < 0.1);
}

TEST_CASE("a recorder's table gives the way of its speeds, and a contact sets the car free") {
  const MotionDrive far(400.0, slowing_table);
  const double start_m = far.car().world_from_vehicle.position_m.x;
  for (int tick = 1; tick <= 480; ++tick) REQUIRE(far.live->next({}).has_value());
  CHECK(far.car().world_from_vehicle.position_m.x - start_m == relative(64.0, 1e-3));
  CHECK_FALSE(far.live->state().motion->is_over);

  const MotionDrive near(60.0, slowing_table);
  for (int tick = 1; tick <= 480; ++tick) REQUIRE(near.live->next({}).has_value());
  CHECK(near.live->state().motion->is_over);
  CHECK(near.live->newest().diagnostics.collisions == 1);
  // The table knows no van.
  CHECK(near.car().world_from_vehicle.position_m.x < far.car().world_from_vehicle.position_m.x - 5.0);
}

TEST_CASE("such a drive is verified, and run again within the ± of its table, which gives the share that crashes") {
  // The front reaches the van's tail at the table's end, or not, by the error of the speeds.
  const MotionDrive drive(10.0 + 64.0 + 3.722 + 1.2 + 1.0, slowing_table);
  auto log = SessionLog::create(drive.loaded, {.out = drive.folder.path(), .no_screens = true});
  REQUIRE_MESSAGE(log.has_value(), why_not(log));
  drive.live->log_to(*log);
  while (drive.live->state().tick < 480) REQUIRE(drive.live->next({}).has_value());
  REQUIRE(log->finish(log->outcome({}, {})).has_value());
  const auto session = drive.folder / "session.sqlite";
  const auto verified = run_verify(session, 0.0);
  CHECK_MESSAGE(verified.has_value(), why_not(verified));
  std::ostringstream out;
  const auto changed =
      run_what_if({.session = session, .changes = {"brake:=0.8@1s"}, .run = {}, .out = drive.folder / "none"}, out);
  CHECK(why_not(changed).find("goes by a table") != std::string::npos);
  const auto done = run_what_if({.session = session, .changes = {}, .runs = 24, .run = {}, .out = {}}, out);
  REQUIRE_MESSAGE(done.has_value(), why_not(done));
  CHECK(out.str().find("as logged: no collision") != std::string::npos);
  CHECK(out.str().find(" of 24 variants collide") != std::string::npos);
  CHECK(out.str().find("\n0 of 24 variants") == std::string::npos);
  CHECK(out.str().find("\n24 of 24 variants") == std::string::npos);

  // Runs as sessions of their own: each is that of its row, is verified with its departure, and differs from the next.
  std::ostringstream told;
  const auto kept = run_what_if(
      {.session = session, .changes = {}, .runs = 2, .sessions = 2, .run = {}, .out = drive.folder / "runs"}, told);
  REQUIRE_MESSAGE(kept.has_value(), why_not(kept));
  std::vector<std::string> departures;
  for (const char* name : {"run-1.sqlite", "run-2.sqlite"}) {
    CAPTURE(std::string(name));
    const auto file = drive.folder / "runs" / name;
    CHECK(told.str().find(" --ghost " + file.string()) != std::string::npos);
    const auto same = run_verify(file, 0.0);
    CHECK_MESSAGE(same.has_value(), why_not(same));
    const auto run = logging::SessionReader::open(file);
    REQUIRE_MESSAGE(run.has_value(), why_not(run));
    CHECK(run->shown_span_s()->second == doctest::Approx(4.0));  // As long as the session.
    departures.push_back(run->info().other.at("motion_deviation"));
  }
  CHECK(departures[0] != departures[1]);

  std::ostringstream none;
  const LoggedCrash driven;
  const auto refused = run_what_if({.session = driven.session, .changes = {}, .runs = 3, .run = {}, .out = {}}, none);
  REQUIRE_FALSE(refused.has_value());
  CHECK(refused.error().what == "somebody drives in this session: there is no table to depart from");
}

}  // namespace septet::server
