#include <limits>
#include <string>

#include <doctest/doctest.h>

#include "tests/sim-server/golden_hashes/golden_hashes.hpp"

namespace septet::server {
namespace {

/// Staged crashes, which end by themselves before.
bool is_short(const std::string& scenario) {
  return scenario == "crossing-crash" || scenario == "pile-up" || scenario == "walker-behind-van";
}

}  // namespace

TEST_CASE("every shipped scenario drives half a minute, or nearly to its end, to its golden hashes") {
  check_golden_hashes(std::numeric_limits<Tick>::max());
  for (const auto& drive : read_golden().drives)
    CHECK_MESSAGE(drive.second.rbegin()->first >= (is_short(drive.first.scenario) ? 1320 : 3600), drive.first.scenario);
}

}  // namespace septet::server
