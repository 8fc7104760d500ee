// The ambulance experiment, one minute of it; ten seeds of the whole are in ambulance_chase_long_test.cpp.

#include "tests/sim-server/ambulance_chase.hpp"
#include "tests/sim-server/shipped_drive.hpp"

namespace septet::server {

TEST_CASE("the driver follows the ambulance through the rescue lane half as fast again as the traffic") {
  const AmbulanceChase chase = chase_ambulance("rescue-lane", "escort", 31, 75.0);
  MESSAGE(in_words(31, chase));
  check_chase(chase);
}

TEST_CASE("the ambulance of the motorway drives into nobody") {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    const AmbulanceChase chase = chase_ambulance("behind-ambulance", "plain", seed, 60.0);
    MESSAGE(in_words(seed, chase));
    CHECK(chase.ambulance_overlaps_s10 == 0);
  }
}

}  // namespace septet::server
