// The reader for statistics programs (logging/python) agrees with the C++ reader.
#include <cstdlib>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "engine/math/rigid_transform.hpp"
#include "logging/study/report/group_report.hpp"
#include "tests/checkout.hpp"
#include "tests/logging/session_fixture.hpp"

namespace septet::logging {
namespace {

/// Vehicles enter, leave, stand, and one accelerates: every kind of difference.
Snapshot busy_snapshot(Tick tick) {
  Snapshot snapshot = drive_snapshot(tick, 3 + static_cast<int>(tick / 40) % 4);
  for (Participant& participant : snapshot.participants) {
    participant.model = static_cast<ModelIndex>(participant.id % 7);
    participant.acceleration_mps2 = {-0.4 * participant.id, 1.25, 0.0};
    participant.angular_velocity_radps = {0.0, 0.0, 0.3};
    participant.wheel_spin_radps = 93.0;
    participant.wheel_spin_rad = 0.775 * static_cast<double>(tick % 8);
    participant.lamps.set(Lamp::brake, tick % 50 < 20);
    participant.front_steer_rad = 0.01 * participant.id;
  }
  return snapshot;
}

int run_check(const std::string& arguments) {
  return std::system(
      ("/usr/bin/python3 " + source_folder() + "/tests/logging/python_reader_check.py " + arguments).c_str());
}

}  // namespace

TEST_CASE("the Python reader has everybody at every tick where the C++ reader has them, across keyframes") {
  const TemporaryFolder folder;
  const auto session = folder.path() / "session.sqlite", csv = folder.path() / "expected.csv";
  {
    SessionWriter writer = must_create(session);
    for (Tick tick = 0; tick < 300; ++tick) {
      const Snapshot snapshot = busy_snapshot(tick);
      writer.record(taken(snapshot));
      if (is_sample_due(tick, 120.0)) writer.record(take_sample(snapshot, std::nullopt));
    }
    // A participant whose number a solid has, in two places one after the other.
    for (const char* const command : {"stand solid=1 x_m=1 height_m=2 name=\"stimuli/gate\"",
                                      "stand solid=1 x_m=2 height_m=2 name=\"stimuli/a wall\"", "clear solid=1"})
      writer.record(Event{0, 0.0, std::string(operator_command_kind), std::nullopt, command});
    REQUIRE(writer.finish().has_value());
  }
  std::ofstream out(csv);
  out << "tick,simulated_time_s,participant,model,lamps,x_m,y_m,z_m,qw,qx,qy,qz,velocity_x_mps,acceleration_y_mps2,"
         "angular_velocity_z_radps,front_steer_rad,wheel_spin_rad,wheel_spin_radps\n";
  auto reader = SessionReader::open(session);
  REQUIRE(reader.has_value());
  auto cursor = reader->snapshots();
  REQUIRE(cursor.has_value());
  for (;;) {
    const auto next = cursor->next();
    REQUIRE(next.has_value());
    if (!*next) break;
    for (const Participant& p : (*next)->participants) {
      const Vec3& at = p.world_from_vehicle.position_m;
      const Quat& q = p.world_from_vehicle.orientation;
      out << fmt::format(
          "{},{:.17g},{},{},{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},"
          "{:.17g},{:.17g}\n",
          (*next)->tick, (*next)->simulated_time_s, p.id, p.model, p.lamps.bits, at.x, at.y, at.z, q.w, q.x, q.y, q.z,
          p.velocity_mps.x, p.acceleration_mps2.y, p.angular_velocity_radps.z, p.front_steer_rad, p.wheel_spin_rad,
          p.wheel_spin_radps);
    }
  }
  out.close();
  CHECK(run_check(session.string() + " " + csv.string()) == 0);
}

TEST_CASE("codes of participants survive pandas by the lines that docs/experiments.md gives") {
  const TemporaryFolder folder;
  const std::vector<std::string> codes{"'07",  "+3",  "-x", "007", "1e5",
                                       "=1+1", "@me", "NA", "nan", "null"};  // In the table's order.
  std::vector<std::filesystem::path> sessions;
  for (const std::string& code : codes) {
    sessions.push_back(folder / std::to_string(sessions.size()) / "session.sqlite");
    std::filesystem::create_directories(sessions.back().parent_path());
    SessionInfo info = example_info();
    info.participant = code;
    auto writer = SessionWriter::create(sessions.back(), info);
    REQUIRE(writer.has_value());
    REQUIRE(writer->finish().has_value());
  }
  auto subjects = pool_sessions(sessions, {});
  REQUIRE(subjects.has_value());
  GroupReport report;
  report.subjects = std::move(*subjects);
  std::ofstream(folder / "subjects.csv") << to_csv(report);
  std::ifstream document(source_folder() + "/docs/experiments.md");
  std::string lines;
  for (std::string line; std::getline(document, line);)
    if (line.starts_with("subjects = pandas.read_csv(") || line.starts_with("subjects.participant = "))
      lines += line + '\n';
  std::string expected;
  for (const std::string& code : codes) expected += (expected.empty() ? "" : ", ") + ('"' + code + '"');
  std::ofstream(folder / "read.py") << "import pandas\n"
                                    << lines << "assert list(subjects.participant) == [" << expected
                                    << "], list(subjects.participant)\nassert subjects.distance_m.isna().all()\n";
  CHECK(std::system(fmt::format("cd '{}' && /usr/bin/python3 read.py", folder.path().string()).c_str()) == 0);
}

}  // namespace septet::logging
