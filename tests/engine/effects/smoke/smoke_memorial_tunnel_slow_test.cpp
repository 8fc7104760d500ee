/// Smoke against the draught of the Memorial Tunnel's jet fans: who turned it back and who did not, by Kile and Gonzalez
/// (ASHRAE Transactions 103, part 2, 1997), as tabulated in C. Fleming's comparison with Li's law
/// (github.com/conorfleming/memorial_tunnel_bl_analysis, 2020). Back-layering is "yes" over 61 m, "no" under 12 m.
/// docs/smoke.md has the table, and two fires of more power, whose layers are too long here.

#include <vector>

#include <doctest/doctest.h>

#include "smoke_fixtures.hpp"
#include "tests/engine/effects/smoke/fire_of_power.hpp"

using namespace septet;
using namespace septet::smoke;

namespace {

constexpr int fire_m = 160, length_m = 320;

/// Layer before the fire after 2 min, the mean of 10 s. The tunnel without its false ceiling, as metre cells: 9 × 8 m
/// for 8.8 × 7.9 m; level, where the tunnel falls by 3.2 %.
double layer_against_m(double power_mw, double draught_mps) {
  State state = make_smoke(make_grid({}, 1.0, length_m, 9, 8, open_x_low | open_x_high),
                           {fire_of_power({fire_m, 4.5, 2.0}, power_mw)}, 1, 20'000, under_a_roof());
  burn(state, 110.0, draught_mps);
  double mean_m = 0.0;
  for (int n = 0; n < 5; ++n) {
    burn(state, 2.0, draught_mps);
    mean_m += reach_m(state, fire_m, -1) / 5.0;
  }
  return mean_m;
}

struct Measured {
  double power_mw, draught_fpm;
  bool layer;
};

}  // namespace

TEST_CASE("smoke goes against the draught of the Memorial Tunnel where it did there and is turned back where it was") {
  constexpr double fpm = 0.3048 / 60.0;
  for (const Measured& test : std::vector<Measured>{{9.3, 300, true},
                                                    {11.4, 467, false},
                                                    {13.8, 388, true},
                                                    {15.6, 513, false},
                                                    {47.9, 481, true},
                                                    {52.4, 617, false}}) {
    const double layer_m = layer_against_m(test.power_mw, test.draught_fpm * fpm);
    MESSAGE(test.power_mw << " MW, " << test.draught_fpm * fpm << " m/s: " << layer_m << " m");
    CAPTURE(test.power_mw);
    // A third less than what was seen at the least, and the metres that smoke spreads by its crowd.
    if (test.layer)
      CHECK(layer_m > 40.0);
    else
      CHECK(layer_m < 15.0);
  }
}
