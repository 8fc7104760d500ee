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

}  // namespace septet::server
