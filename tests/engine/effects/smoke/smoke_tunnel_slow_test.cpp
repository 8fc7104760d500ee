#include <doctest/doctest.h>

#include <cmath>
#include <utility>

#include "engine/effects/smoke/visibility.hpp"
#include "smoke_fixtures.hpp"

using namespace septet;
using namespace septet::smoke;

TEST_CASE("a draught carries smoke out of the portal it blows towards") {
  const auto mean_x = [](double draught_mps) {
    State state = tunnel_fire(1, 3000);
    const Vec3 wind = state.grid.world_from_grid.orientation * Vec3(draught_mps, 0.0, 0.0);
    int left = 0;
    for (int tick = 0; tick < 900; ++tick) left += advance_smoke(state, wind, {}, step_s).left;
    double sum = 0.0;
    for (const float x : state.particles.x) sum += x;
    return std::pair(sum / static_cast<double>(state.particles.size()), left);
  };
  const auto [still, none_left] = mean_x(0.0);
  const auto [blown, left] = mean_x(5.0);
  CHECK(std::abs(still - 60.0) < 4.0);
  CHECK(none_left == 0);
  CHECK(blown > 75.0);
  CHECK(left > 0);
}

TEST_CASE("a tunnel fire hides the far portal under the ceiling before it does on the road") {
  State state = tunnel_fire(1, 20000);
  for (int tick = 0; tick < 600; ++tick) advance_smoke(state, Vec3(0.0), {}, step_s);
  const auto along = [&](double height_m) {
    return transmittance(state, state.grid.world_from_grid * Vec3(20.0, 6.0, height_m),
                         state.grid.world_from_grid * Vec3(100.0, 6.0, height_m));
  };
  CHECK(along(5.5) < 0.02);
  CHECK(along(0.5) > 10.0 * along(5.5));
}

TEST_CASE("smoke leaves soot on the walls beside it and nowhere else") {
  State state = tunnel_fire(1, 20000);
  for (int tick = 0; tick < 600; ++tick) advance_smoke(state, Vec3(0.0), {}, step_s);
  float near_fire = 0.0f, far_away = 0.0f;
  for (std::size_t n = 0; n < state.beside_wall.size(); ++n) {
    const int i = static_cast<int>(state.beside_wall[n]) % state.grid.nx;
    REQUIRE(state.soot[n] <= 1.0f);
    if (std::abs(i - 60) < 5) near_fire += state.soot[n];
    if (i < 5) far_away += state.soot[n];
  }
  CHECK(near_fire > 0.0f);
  CHECK(far_away == 0.0f);
}
