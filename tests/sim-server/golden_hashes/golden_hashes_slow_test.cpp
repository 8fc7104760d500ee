#include <limits>

#include <doctest/doctest.h>

#include "tests/sim-server/golden_hashes/golden_hashes.hpp"

namespace septet::server {

TEST_CASE("every shipped scenario drives half a minute to its golden hashes") {
  check_golden_hashes(std::numeric_limits<Tick>::max());
  for (const auto& drive : read_golden().drives)
    CHECK_MESSAGE(drive.second.rbegin()->first == 3600, drive.first.scenario);
}

}  // namespace septet::server
