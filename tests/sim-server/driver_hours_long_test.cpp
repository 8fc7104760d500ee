// Twenty hours on the motorway with each simulated driver, in ten seeds: nothing that a person would not do.
//
//     ./test --long -R 'hours on the motorway'
//
// SEPTET_DRIVER_HOURS shortens it; the drives are shared among the machine's cores.

#include <atomic>
#include <cstdlib>
#include <numeric>
#include <thread>

#include "tests/sim-server/driver_hours.hpp"
#include "tests/sim-server/shipped_drive.hpp"

namespace septet::server {
namespace {

constexpr int seeds = 10;
/// The drives of a seed follow each other with seeds of their own.
constexpr std::uint64_t next_drive = 1000;
constexpr double drive_s = 285.0;  ///< Until just before the scenario's end, 8.5 km on.

double hours_each() {
  const char* hours = std::getenv("SEPTET_DRIVER_HOURS");
  return hours ? std::atof(hours) : 20.0;
}

std::vector<DrivingRecord> drive_for_hours(const std::string& driver, double hours) {
  const int drives = std::max(1, static_cast<int>(std::ceil(hours * 3600.0 / drive_s)));
  std::vector<DrivingRecord> records(static_cast<std::size_t>(drives));
  std::atomic<int> next = 0;
  const auto work = [&] {
    for (int i = next++; i < drives; i = next++) {
      const auto seed = static_cast<std::uint64_t>(1 + i % seeds) + next_drive * static_cast<std::uint64_t>(i / seeds);
      records[static_cast<std::size_t>(i)] = watch_drive("motorway-ambulance", driver, seed, drive_s).finish();
    }
  };
  std::vector<std::thread> workers;
  for (unsigned i = 0; i < std::max(1u, std::thread::hardware_concurrency()); ++i) workers.emplace_back(work);
  for (std::thread& worker : workers) worker.join();
  return records;
}

void check_hours(const std::string& driver) {
  DrivingRecord all;
  for (const DrivingRecord& record : drive_for_hours(driver, hours_each())) all.add(record);
  const double hours = all.time_s / 3600.0;
  for (const std::string& incident : all.incidents) MESSAGE(incident);
  MESSAGE(driver << ": " << hours << " h, " << all.way_m / 1000.0 << " km; braked harder than 5 m/s2 " << all.hard_brakings << " times; collisions: own "
                 << all.own_collisions << ", others' " << all.other_collisions << "; stops " << all.stops << "; off the lanes " << all.off_lanes_s
                 << " s; lane changes " << all.lane_changes / hours << " an hour, a glance every " << all.time_s / std::max(1, all.glances) << " s");
  CHECK(all.own_collisions == 0);
  CHECK(all.hard_brakings <= std::max(1.0, hours / 10.0));
  CHECK(all.off_lanes_s == 0.0);
}

}  // namespace

TEST_CASE("the plain driver spends hours on the motorway without an accident of its making") { check_hours("plain"); }
TEST_CASE("the novice spends hours on the motorway without an accident of its making") { check_hours("novice"); }
TEST_CASE("the experienced driver spends hours on the motorway without an accident of its making") { check_hours("experienced"); }
TEST_CASE("the tired driver spends hours on the motorway without an accident of its making") { check_hours("tired"); }

}  // namespace septet::server
