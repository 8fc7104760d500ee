#include <cstdint>

#include <doctest/doctest.h>

#include "tests/engine/traffic/checked_town.hpp"

namespace septet::traffic {

TEST_CASE("in ten minutes of a public town no outlines overlap and nobody stands for three minutes") {
  for (const std::uint32_t count : {40u, 100u}) {
    CAPTURE(count);
    CHECK(checked_town("Town01", count, 600.0, 11).most_sideways_mps2 < most_bend_mps2);
  }
}

}  // namespace septet::traffic
