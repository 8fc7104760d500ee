// Smoke of a fire of known power under a roof, beside published laws: the layer, its front, its standstill against a
// draught, the mixture behind, and the ledger of soot. SMOKE.md has the figures.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <vector>

#include "smoke_fixtures.hpp"
#include "tests/engine/effects/smoke/fire_of_power.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::smoke;

namespace {

constexpr double width_m = 11.0, height_m = 7.0;

/// A level tube of metre cells, and 5 MW at each place.
State tube_with_fires(double length_m, std::initializer_list<double> fires_m) {
  std::vector<Emitter> fires;
  for (const double x_m : fires_m) fires.push_back(fire_of_power({x_m, 0.5 * width_m, 2.0}, 5.0));
  return make_smoke(make_grid({}, 1.0, static_cast<int>(length_m), static_cast<int>(width_m),
                              static_cast<int>(height_m), open_x_low | open_x_high),
                    fires, 1, 20'000, under_a_roof());
}

double in_air_m2(const State& state) {
  double sum = 0.0;
  for (std::size_t n = 0; n < state.particles.size(); ++n)
    sum += state.emitters[state.particles.emitter[n]].extinction_area_m2 * state.particles.births[n];
  return sum;
}

}  // namespace

TEST_CASE("the metre under the roof is the densest from 10 to 60 m on both sides of a fire") {
  State state = tube_with_fires(400.0, {200.0});
  burn(state, 60.0, 0.0);
  for (const int x : {145, 155, 165, 175, 185, 210, 220, 230, 240, 250}) {
    CAPTURE(x);
    const double top = extinction_of(state, 6, x, x + 5);
    for (int k = 0; k < 6; ++k) CHECK(top > extinction_of(state, k, x, x + 5));
    CHECK(top > 4.0 * extinction_of(state, 1, x, x + 5));
  }
}

TEST_CASE("the front of a fire of 5 MW runs at Hinkley's speed") {
  State state = tube_with_fires(400.0, {200.0});
  std::array<int, 3> reach{};
  for (int& r : reach) {
    burn(state, 10.0, 0.0);
    r = (reach_m(state, 200, -1) + reach_m(state, 200, 1)) / 2;
  }
  MESSAGE("front at 10, 20, 30 s: " << reach[0] << ", " << reach[1] << ", " << reach[2] << " m");
  CHECK((reach[2] - reach[0]) / 20.0 == relative(1.8, 0.3));
  CHECK(reach[2] / 30.0 == relative(1.8, 0.3));
}

TEST_CASE("against a draught the layer of 5 MW stands within 35 % of Li's length") {
  constexpr double critical_mps = 2.19;
  for (const double draught_mps : {1.0, 1.5, 2.0}) {
    State state = tube_with_fires(420.0, {200.0});
    burn(state, 200.0, draught_mps);
    const double li_m = 18.5 * height_m * std::log(critical_mps / draught_mps);
    double mean_m = 0.0;
    for (int n = 0; n < 5; ++n) {
      burn(state, 5.0, draught_mps);
      mean_m += reach_m(state, 200, -1) / 5.0;
    }
    MESSAGE("draught " << draught_mps << " m/s: " << mean_m << " m, Li " << li_m << " m");
    CHECK(mean_m == relative(li_m, 0.35));
  }
}

TEST_CASE("a draught of 1.5 m/s mixes the smoke of 5 MW to its mass in the air that passes") {
  constexpr double draught_mps = 1.5;
  State state = tube_with_fires(800.0, {60.0});
  burn(state, 880.0, draught_mps);
  const double given_m2ps = 5.0 / 25.0 * 1000.0 * 0.1 * 8.7;
  double mean_per_m = 0.0;
  for (int n = 0; n < 4; ++n) {
    burn(state, 5.0, draught_mps);
    for (int k = 0; k < 7; ++k) mean_per_m += extinction_of(state, k, 460, 700) / (7.0 * 4.0);
  }
  MESSAGE("extinction " << mean_per_m << " 1/m");
  CHECK(mean_per_m == relative(given_m2ps / (draught_mps * width_m * height_m), 0.05));
  CHECK(given_m2ps / (draught_mps * width_m * height_m) == relative(1.507, 0.001));
}

TEST_CASE("soot of two fires in 800 m for ten minutes is in the air or has left or lies on walls") {
  State state = tube_with_fires(800.0, {300.0, 500.0});
  for (int minute = 1; minute <= 10; ++minute) {
    burn(state, 60.0, 0.3);
    const Ledger& ledger = state.ledger;
    const double owed = ledger.owed_to_walls_m2;
    CHECK(in_air_m2(state) + ledger.left_m2 + ledger.on_walls_m2 - owed == relative(ledger.emitted_m2, 1e-4));
    CHECK(owed < 0.01 * ledger.emitted_m2);
  }
  const double given_m2 = 600.0 * 2.0 * 5.0 / 25.0 * 1000.0 * 0.1 * 8.7;
  CHECK(state.ledger.emitted_m2 == relative(given_m2, 1e-3));
  CHECK(state.refused == 0);
  CHECK(state.particles.size() < state.capacity);
}

TEST_CASE("old cold smoke that lies under the roof comes down to the road") {
  State state = tube_with_fires(120.0, {60.0});
  state.grid.open_faces = 0;
  burn(state, 30.0, 0.0);
  state.emitters[0].rate_per_s = 0.0;
  const double low_before = extinction_of(state, 1, 20, 100), high_before = extinction_of(state, 6, 20, 100);
  burn(state, 300.0, 0.0);
  MESSAGE("at 1.5 and 6.5 m: " << low_before << ", " << high_before << " when the fire goes out, "
                               << extinction_of(state, 1, 20, 100) << ", " << extinction_of(state, 6, 20, 100)
                               << " five minutes later");
  CHECK(low_before < 0.1 * high_before);
  CHECK(extinction_of(state, 1, 20, 100) > 0.5 * extinction_of(state, 6, 20, 100));
}
