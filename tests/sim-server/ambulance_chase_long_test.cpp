// The ambulance experiment in ten seeds:
//
//     ./test --long -R 'follows the ambulance'

#include <cstdlib>

#include "tests/sim-server/ambulance_chase.hpp"
#include "tests/sim-server/shipped_drive.hpp"

namespace septet::server {

TEST_CASE("in ten seeds the driver follows the ambulance through the rescue lane half as fast again as the traffic") {
  for (std::uint64_t seed = 31; seed <= 40; ++seed) {
    const AmbulanceChase chase = chase_ambulance("rescue-lane", "escort", seed, 285.0);
    MESSAGE(in_words(seed, chase));
    check_chase(chase);
  }
}

TEST_CASE("in ten seeds the ambulance of the motorway drives into nobody") {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const AmbulanceChase chase = chase_ambulance("behind-ambulance", "plain", seed, 285.0);
    MESSAGE(in_words(seed, chase));
    CHECK(chase.ambulance_overlaps_s10 == 0);
  }
}

}  // namespace septet::server
