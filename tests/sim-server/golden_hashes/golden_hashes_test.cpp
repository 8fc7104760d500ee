/// Each shipped scenario, driven for some seconds by a simulated driver, ends in the state whose hash `golden_hashes` beside
/// this file holds: whatever the compiler, its optimisation and its checks (.ci/run builds this program three times).
///
/// After a change that is meant to move the simulation: SEPTET_RENEW_HASHES=1 build/release/golden_hashes_test, and commit.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include <doctest/doctest.h>
#include <fmt/core.h>

#include "sim-server/drive/driver_seat.hpp"
#include "tests/sim-server/shipped_drive.hpp"

namespace septet::server {
namespace {
namespace fs = std::filesystem;

const fs::path golden_file = fs::path(SEPTET_SOURCE_DIR) / "tests/sim-server/golden_hashes/golden_hashes";

struct DriveKey {
  std::string scenario, driver;
  std::uint64_t seed = 0;
  auto operator<=>(const DriveKey&) const = default;
};

/// Of one drive: the hash that it has at some ticks; more than one, so that a failure says how early the states part.
using HashAtTick = std::map<Tick, std::string>;

struct GoldenFile {
  std::string heading;  ///< The lines of comment at its top.
  std::map<DriveKey, HashAtTick> drives;
};

GoldenFile read_golden() {
  std::ifstream in(golden_file);
  REQUIRE_MESSAGE(in.is_open(), golden_file.string());
  GoldenFile golden;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with('#')) {
      golden.heading += line + "\n";
      continue;
    }
    std::istringstream words(line);
    DriveKey key;
    Tick tick = 0;
    std::string hash;
    REQUIRE_MESSAGE((words >> key.scenario >> key.driver >> key.seed >> tick >> hash), line);
    golden.drives[key][tick] = hash;
  }
  return golden;
}

/// Drives as the product does, without screens or log, to the last of these ticks.
HashAtTick drive(const DriveKey& key, const HashAtTick& expected) {
  const LoadedDrive loaded = shipped_drive(key.scenario, "seven-screens", key.seed);
  auto seat = open_driver_seat(rig::Car{.driver = key.driver}, key.seed, loaded.model);
  REQUIRE(seat.has_value());
  auto live = LiveDrive::start(loaded.model, traffic::own_traffic(loaded.model->roads, key.seed), std::move(*seat));
  REQUIRE(live.has_value());
  HashAtTick reached;
  while ((*live)->newest().tick < expected.rbegin()->first) {
    const auto tick = (*live)->next(std::nullopt);
    REQUIRE((tick.has_value() && *tick));
    const Snapshot& snapshot = (*live)->newest();
    if (expected.contains(snapshot.tick)) reached[snapshot.tick] = fmt::format("{:016x}", snapshot.state_hash);
  }
  return reached;
}

}  // namespace

TEST_CASE("every shipped scenario drives to its golden hashes with every compiler") {
  GoldenFile golden = read_golden();
  for (auto& golden_drive : golden.drives) {
    const DriveKey& key = golden_drive.first;
    const HashAtTick reached = drive(key, golden_drive.second);
    for (const auto& expected : golden_drive.second) {
      INFO(key.scenario << " " << key.driver << " seed " << key.seed << " tick " << expected.first);
      CHECK(reached.at(expected.first) == expected.second);
    }
    golden_drive.second = reached;
  }
  if (std::getenv("SEPTET_RENEW_HASHES") == nullptr) return;
  std::ofstream out(golden_file);
  out << golden.heading;
  for (const auto& [key, hashes] : golden.drives)
    for (const auto& [tick, hash] : hashes)
      out << fmt::format("{} {} {} {} {}\n", key.scenario, key.driver, key.seed, tick, hash);
}

TEST_CASE("no shipped scenario is without a golden hash") {
  std::set<std::string> shipped, golden;
  for (const auto& entry : fs::directory_iterator(fs::path(SEPTET_SOURCE_DIR) / "scenarios"))
    if (fs::exists(entry.path() / (entry.path().filename().string() + ".xosc")))
      shipped.insert(entry.path().filename().string());
  for (const auto& [key, hashes] : read_golden().drives) golden.insert(key.scenario);
  CHECK(shipped.size() >= 4);
  CHECK(golden == shipped);
}

}  // namespace septet::server
