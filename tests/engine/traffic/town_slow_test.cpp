#include <cstdint>

#include <doctest/doctest.h>

#include "tests/engine/traffic/checked_town.hpp"

namespace septet::traffic {

TEST_CASE("in ten minutes of a public town no outlines overlap and nobody stands for three minutes") {
  for (const char* town : {"Town01", "Town03"})
    for (const std::uint32_t count : {40u, 100u}) checked_town(town, count, 600.0, 11);
}

}  // namespace septet::traffic
