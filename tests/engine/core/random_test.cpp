#include "engine/core/random.hpp"

#include <array>
#include <cmath>

#include <doctest/doctest.h>

using namespace septet;

TEST_CASE("the generator is xoshiro256++ as its authors publish it") {
  auto random = Random::from_state({1, 2, 3, 4});
  REQUIRE(random);
  const std::array<std::uint64_t, 6> published{
      41943041, 58720359, 3588806011781223, 3591011842654386, 9228616714210784205u, 9973669472204895162u};
  for (const std::uint64_t expected : published) CHECK(random->next_bits() == expected);
}

TEST_CASE("normal deviates lie on both sides of zero as Gauss says") {
  Random random(7);
  constexpr int count = 20000;
  int left = 0, beyond = 0;
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < count; ++i) {
    const double x = random.normal();
    left += x < 0.0;
    beyond += std::abs(x) > 1.959964;
    sum += x, squares += x * x;
  }
  CHECK(std::abs(sum / count) < 0.03);
  CHECK(std::abs(squares / count - 1.0) < 0.04);
  CHECK(std::abs(left / double(count) - 0.5) < 0.015);
  CHECK(std::abs(beyond / double(count) - 0.05) < 0.007);
}

TEST_CASE("no value below a count is likelier than another however large the count") {
  Random random(3);
  constexpr std::uint64_t quarter = std::uint64_t{1} << 62;
  std::array<int, 3> found{};
  for (int i = 0; i < 3000; ++i) ++found[static_cast<std::size_t>(random.below(3 * quarter) / quarter)];
  for (const int in_third : found) CHECK(std::abs(in_third - 1000) < 130);
}
