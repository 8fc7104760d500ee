#include <cstdint>

#include <doctest/doctest.h>

#include "tests/engine/traffic/checked_town.hpp"

namespace septet::traffic {

TEST_CASE("in an hour of a public town no outlines overlap and nobody stands for three minutes") {
  for (const char* town : {"Town01", "Town03"})
    for (const std::uint32_t count : {40u, 100u}) checked_town(town, count, 3600.0, 21);
}

TEST_CASE("a roundabout of a full town whose ways out fill does not lock, whatever the draw") {
  // With 38 and 1002 somebody had stood for 3,390 and 2,976 s.
  for (const std::uint64_t seed : {38u, 1001u, 1002u}) checked_town("Town03", 100, 3600.0, seed);
}

}  // namespace septet::traffic
