// The simulated driver goes where he is told, among the traffic, by the roads' own rules.

#include "tests/sim-server/guided/guided_drive.hpp"

namespace septet::server {

TEST_CASE("the driver reaches ten goals in the own town without a collision or a wrong turn") {
  reaches(shipped_drive("town", "desktop"),
          {"Landstraße (south east)", "Landstraße (north)", "Kirchgasse", "Nordring", "Landstraße (east)",
           "Schillerstraße", "Ostring", "Rosenweg", "Bahnhofsplatz", "Bahnhofstraße"},
          500.0);
}

TEST_CASE("the driver reaches goals in a public town without a collision or a wrong turn") {
  const TemporaryFolder folder;
  reaches(public_town_drive("Town01", folder), {"1", "3", "5", "10", "17", "22"}, 400.0);
}

}  // namespace septet::server
