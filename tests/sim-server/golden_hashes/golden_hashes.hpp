#pragma once
/// State hashes of each shipped scenario under a simulated driver, held in `golden_hashes` beside this file:
/// independent of compiler, optimisation and checks (.ci/run builds the fast test three times: gcc, clang, and gcc
/// without optimisation).
///
/// After an intended change of the simulation: run golden_hashes_test and golden_hashes_slow_test of build/release with
/// SEPTET_RENEW_HASHES=1, and commit.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include <doctest/doctest.h>
#include <fmt/core.h>

#include "sim-server/drive/driver_seat.hpp"
#include "tests/checkout.hpp"
#include "tests/sim-server/simulated_drive.hpp"

namespace septet::server {

/// Fast tests use the rows up to this tick, the slow one all of them.
inline constexpr Tick last_fast_tick = 1200;

inline std::filesystem::path golden_file() {
  return std::filesystem::path(source_folder()) / "tests/sim-server/golden_hashes/golden_hashes";
}

struct DriveKey {
  std::string scenario, driver;
  std::uint64_t seed = 0;
  auto operator<=>(const DriveKey&) const = default;
};

/// For one drive: its hash at some ticks; more than one, so that a failure tells how early the states part.
using HashAtTick = std::map<Tick, std::string>;

struct GoldenFile {
  std::string heading;  ///< Comment lines at its top.
  std::map<DriveKey, HashAtTick> drives;
};

inline GoldenFile read_golden() {
  std::ifstream in(golden_file());
  REQUIRE_MESSAGE(in.is_open(), golden_file().string());
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
inline HashAtTick drive(const DriveKey& key, const HashAtTick& expected) {
  const LoadedDrive loaded = shipped_drive(key.scenario, "seven-screens", key.seed);
  const auto live = simulated_drive(loaded, key.driver, key.seed);
  HashAtTick reached;
  while (live->newest().tick < expected.rbegin()->first) {
    const auto tick = live->next(std::nullopt);
    REQUIRE((tick.has_value() && *tick));
    const Snapshot& snapshot = live->newest();
    if (expected.contains(snapshot.tick)) reached[snapshot.tick] = fmt::format("{:016x}", snapshot.state_hash);
  }
  return reached;
}

/// Checks every drive of the file up to that tick; renews the hashes on request, and leaves later ones alone.
inline void check_golden_hashes(Tick last_tick) {
  GoldenFile golden = read_golden();
  for (auto& golden_drive : golden.drives) {
    const DriveKey& key = golden_drive.first;
    HashAtTick& hashes = golden_drive.second;
    const HashAtTick expected(hashes.begin(), hashes.upper_bound(last_tick));
    for (const auto& reached : drive(key, expected)) {
      INFO(key.scenario << " " << key.driver << " seed " << key.seed << " tick " << reached.first);
      CHECK(expected.at(reached.first) == reached.second);
      hashes[reached.first] = reached.second;
    }
  }
  if (std::getenv("SEPTET_RENEW_HASHES") == nullptr) return;
  std::ofstream out(golden_file());
  out << golden.heading;
  for (const auto& [key, hashes] : golden.drives)
    for (const auto& [tick, hash] : hashes)
      out << fmt::format("{} {} {} {} {}\n", key.scenario, key.driver, key.seed, tick, hash);
}

}  // namespace septet::server
