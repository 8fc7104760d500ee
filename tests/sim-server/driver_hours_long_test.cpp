// Twenty hours on the motorway with each simulated driver, in ten seeds: without deviations from a person's driving.
//
//     ./test --long -R 'hours on the motorway'
//
// The drives are shared among the processor cores that the process may use. From the environment: SEPTET_DRIVER_HOURS
// shortens it, SEPTET_DRIVER_FIRST_SEED takes other seeds (1 by default), SEPTET_DRIVER_SCENARIO another motorway,
// SEPTET_DRIVER_REPORT names a file to which every drive adds a line, and a line for its deviations from people, as
// soon as it ends.

#include <cstdlib>
#include <fstream>
#include <mutex>
#include <optional>
#include <thread>

#include "tests/sim-server/driver_hours.hpp"
#include "tests/sim-server/shipped_drive.hpp"

namespace septet::server {
namespace {

constexpr std::uint64_t seeds = 10;
/// The drives of a seed follow each other with seeds of their own.
constexpr std::uint64_t next_drive = 1000;
constexpr double drive_s = 285.0;  ///< Until just before the scenario's end, 8.5 km on.

std::string from_environment(const char* name, const char* otherwise) {
  const char* value = std::getenv(name);
  return value ? value : otherwise;
}

/// Adds a drive's result to the report, for people who wait; one thread at a time.
class Report {
 public:
  explicit Report(const std::string& path) {
    if (!path.empty()) file_.open(path, std::ios::app);
  }
  void add(const std::string& driver, std::uint64_t seed, const DrivingRecord& record) {
    file_ << driver << " seed " << seed << ": " << describe(record) << '\n';
    for (const std::string& incident : record.incidents) file_ << "  " << incident << '\n';
    file_ << std::flush;
  }

 private:
  std::ofstream file_;
};

DrivingRecord drive_for_hours(const std::string& driver) {
  const double hours = std::stod(from_environment("SEPTET_DRIVER_HOURS", "20"));
  const std::string scenario = from_environment("SEPTET_DRIVER_SCENARIO", "behind-ambulance");
  const std::uint64_t first_seed = std::stoull(from_environment("SEPTET_DRIVER_FIRST_SEED", "1"));
  Report report(from_environment("SEPTET_DRIVER_REPORT", ""));
  std::mutex mutex;
  DrivingRecord all;
  std::uint64_t next = 0;
  const auto next_seed = [&]() -> std::optional<std::uint64_t> {
    const std::lock_guard lock(mutex);
    if (all.time_s >= hours * 3600.0) return std::nullopt;
    const std::uint64_t i = next++;
    return first_seed + i % seeds + next_drive * (i / seeds);
  };
  const auto work = [&] {
    for (auto seed = next_seed(); seed; seed = next_seed()) {
      const DrivingRecord record = watch_drive(scenario, driver, *seed, drive_s).finish();
      const std::lock_guard lock(mutex);
      all.add(record);
      report.add(driver, *seed, record);
    }
  };
  std::vector<std::thread> workers;
  for (unsigned i = 0; i < std::max(1u, std::thread::hardware_concurrency()); ++i) workers.emplace_back(work);
  for (std::thread& worker : workers) worker.join();
  return all;
}

void check_hours(const std::string& driver) {
  const DrivingRecord all = drive_for_hours(driver);
  for (const std::string& incident : all.incidents) MESSAGE(incident);
  MESSAGE(driver << ": " << describe(all));
  CHECK(all.own_collisions == 0);
  CHECK(all.hard_brakings * 36000.0 < all.time_s);  // Below one in ten hours.
  CHECK(all.off_lanes_s == 0.0);
}

}  // namespace

TEST_CASE("the plain driver spends hours on the motorway without an accident of its making") { check_hours("plain"); }
TEST_CASE("the novice spends hours on the motorway without an accident of its making") { check_hours("novice"); }
TEST_CASE("the experienced driver spends hours on the motorway without an accident of its making") {
  check_hours("experienced");
}
TEST_CASE("the tired driver spends hours on the motorway without an accident of its making") { check_hours("tired"); }

}  // namespace septet::server
