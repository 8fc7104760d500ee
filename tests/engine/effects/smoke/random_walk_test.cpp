// The random walk out of crowded cells.

#include <cmath>

#include <doctest/doctest.h>

#include "engine/effects/smoke/smoke_state.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::smoke;

namespace {

/// Standard deviation, along an axis and in cells, of the path of smoke of equal density everywhere: only the random
/// walk moves it.
Vec3 spread_cells(int particles_in_cell, int steps, double step_s) {
  constexpr int cells = 12, rim = 3;
  Emitter still;
  still.heat = 0.0;
  still.lifetime_s = 0.0;
  State state = make_smoke(make_grid({}, 1.0, cells, cells, cells, 0), {still}, 5);
  for (int k = 0; k < cells; ++k)
    for (int j = 0; j < cells; ++j)
      for (int i = 0; i < cells; ++i)
        for (int n = 0; n < particles_in_cell; ++n) REQUIRE(add_particle(state, {i + 0.5, j + 0.5, k + 0.5}, 0));
  for (int n = 0; n < steps; ++n) advance_smoke(state, Vec3(0.0), {}, step_s);
  Vec3 sum(0.0), squares(0.0);
  double count = 0.0;
  const Particles& p = state.particles;
  for (std::size_t n = 0; n < p.size(); ++n) {
    const Vec3 place(p.x[n], p.y[n], p.z[n]);
    const Vec3 cell = glm::floor(place), way = place - cell - 0.5;
    if (std::min({cell.x, cell.y, cell.z}) < rim || std::max({cell.x, cell.y, cell.z}) >= cells - rim) continue;
    sum += way;
    squares += way * way;
    count += 1.0;
  }
  for (int axis = 0; axis < 3; ++axis) CHECK(std::abs(sum[axis] / count) < 0.01);
  return glm::sqrt(squares / count);
}

}  // namespace

TEST_CASE("smoke in a full cell walks by the stated deviation and grows with the root of time") {
  const Parameters parameters;
  // Attraction −1 lies three times ½ below ½.
  const double expected = 3.0 * parameters.jitter_cells;
  for (const int steps : {1, 4}) {
    CAPTURE(steps);
    const Vec3 spread = spread_cells(10, steps, 5e-5);
    for (int axis = 0; axis < 3; ++axis) CHECK(spread[axis] == relative(expected * std::sqrt(5e-5 * steps), 0.05));
  }
}

TEST_CASE("at the crowd smoke walks a third as far and in a thin cell not at all") {
  const Parameters parameters;
  const Vec3 crowd = spread_cells(5, 4, 5e-5), thin = spread_cells(2, 4, 5e-5);
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(crowd[axis] == relative(parameters.jitter_cells * std::sqrt(2e-4), 0.07));
    CHECK(thin[axis] < 1e-6);
  }
}
