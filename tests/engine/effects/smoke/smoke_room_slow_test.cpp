#include <doctest/doctest.h>

#include <string>

#include "engine/effects/smoke/attraction.hpp"
#include "smoke_fixtures.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::smoke;

namespace {

struct History {
  std::array<Layers, 5> at;  ///< After 1, 5, 10, 25 and 50 s.
  int most = 0;
};

template <class Advance>
History fifty_seconds(std::uint16_t most_in_cell, Advance&& advance) {
  State state = paper_room();
  state.parameters.most_in_cell = most_in_cell;
  History history;
  constexpr std::array<int, 5> ticks{60, 300, 600, 1500, 3000};
  std::size_t next = 0;
  for (int tick = 1; tick <= 3000; ++tick) {
    if (tick == 1501) state.emitters[0].rate_per_s = 0.0;
    advance(state);
    if (tick % 5 == 0) history.most = std::max(history.most, layers_of(state).most);
    if (tick == ticks[next]) history.at[next++] = layers_of(state);
  }
  CHECK(static_cast<double>(state.particles.size()) + state.emitters[0].owed == doctest::Approx(18432.0));
  CHECK(particles_in_full_cells(state) == 0);
  return history;
}

}  // namespace

TEST_CASE("the published update rises to the ceiling and fills the room from above") {
  const History history = fifty_seconds(65535, [](State& s) { advance_smoke_literally(s, step_s); });
  const std::array<double, 5> heights{0.31, 0.63, 0.68, 0.61, 0.55};
  for (std::size_t n = 0; n < 5; ++n) CHECK(history.at[n].mean == relative(heights[n], 0.05));
  const std::array<double, 4> at_10s{0.05, 0.12, 0.34, 0.49}, at_50s{0.19, 0.24, 0.26, 0.32};
  for (std::size_t q = 0; q < 4; ++q) {
    CHECK(std::abs(history.at[2].quarters[q] - at_10s[q]) < 0.04);
    CHECK(std::abs(history.at[4].quarters[q] - at_50s[q]) < 0.04);
  }
  // And it clumps, because a particle does not see its own cell.
  CHECK(history.most >= 160);
  CHECK(history.at[4].variation > 2.5);
}

TEST_CASE("smoke rises to the ceiling and fills the room from above without clumps") {
  const History history = fifty_seconds(12, [](State& s) { advance_smoke(s, Vec3(0.0), {}, step_s); });
  const std::array<double, 3> heights{0.31, 0.63, 0.68};
  for (std::size_t n = 0; n < 3; ++n) {
    INFO("instant " << n);
    CHECK(std::abs(history.at[n].mean - heights[n]) < 0.03);
  }
  CHECK(history.at[2].quarters[2] + history.at[2].quarters[3] > 0.8);
  CHECK(history.at[2].quarters[0] < 0.1);
  // Without clumps under the ceiling it is as high or lower from then on, and ends as a uniform cloud.
  CHECK(history.at[3].mean > 0.5);
  CHECK(history.at[3].mean < 0.64);
  CHECK(std::abs(history.at[4].mean - 0.5) < 0.06);
  for (const double quarter : history.at[4].quarters) CHECK(std::abs(quarter - 0.25) < 0.07);
  CHECK(history.most <= 12);
  CHECK(history.at[4].variation < 1.1);
}

TEST_CASE("without heat smoke does not gather under the ceiling") {
  State state = paper_room();
  state.emitters[0].heat = 0.0;
  for (int tick = 0; tick < 600; ++tick) advance_smoke(state, Vec3(0.0), {}, step_s);
  CHECK(layers_of(state).mean < 0.5);
}
