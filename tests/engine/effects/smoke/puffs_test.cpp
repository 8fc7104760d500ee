// Birth, thinning and drawing of particles.

#include <cmath>

#include <doctest/doctest.h>

#include "engine/effects/smoke/smoke_keyframe.hpp"
#include "smoke_fixtures.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::smoke;

namespace {

Keyframe one_particle(bool newborn, float age_s) {
  Keyframe keyframe;
  keyframe.world_from_grid.position_m = {100.0, 0.0, 5.0};
  keyframe.cell_m = 2.0f;
  keyframe.time_s = 10.0;
  keyframe.duration_s = 0.5f;
  keyframe.looks = {{{0.2f, 0.3f, 0.4f}, 0.6f, 0.8f, 40.0f}};
  keyframe.particles = {{7, 0, newborn, age_s, {1.0f, 2.0f, 3.0f}, {2.0f, 2.0f, 3.0f}}};
  return keyframe;
}

Puff puff_at(const Keyframe& keyframe, double time_s) {
  std::vector<Puff> puffs;
  add_puffs(keyframe, time_s, puffs);
  REQUIRE(puffs.size() == 1);
  return puffs.front();
}

}  // namespace

TEST_CASE("a puff goes from where its keyframe began to where it ends in the keyframe's time and stays there") {
  const Keyframe keyframe = one_particle(false, 3.0f);
  CHECK(puff_at(keyframe, 9.0).position_m.x == doctest::Approx(102.0));
  CHECK(puff_at(keyframe, 10.0).position_m.x == doctest::Approx(102.0));
  CHECK(puff_at(keyframe, 10.125).position_m.x == doctest::Approx(102.5));
  CHECK(puff_at(keyframe, 10.5).position_m.x == doctest::Approx(104.0));
  CHECK(puff_at(keyframe, 12.0).position_m.x == doctest::Approx(104.0));
  CHECK(puff_at(keyframe, 10.0).position_m.y == doctest::Approx(4.0));
  CHECK(puff_at(keyframe, 10.0).position_m.z == doctest::Approx(11.0));
}

TEST_CASE("a newborn puff fades in, and each grows for six seconds and glows for two") {
  CHECK(puff_at(one_particle(true, 0.0f), 10.25).extinction_area_m2 == doctest::Approx(0.3));
  CHECK(puff_at(one_particle(true, 0.0f), 10.5).extinction_area_m2 == doctest::Approx(0.6));
  CHECK(puff_at(one_particle(false, 0.0f), 10.0).extinction_area_m2 == doctest::Approx(0.6));
  const auto radius_m = [](float age_s) { return puff_at(one_particle(false, age_s), 10.0).radius_m; };
  CHECK(radius_m(0.0f) == doctest::Approx(0.84));
  CHECK(radius_m(3.0f) == doctest::Approx(1.12));
  CHECK(radius_m(6.0f) == doctest::Approx(1.4));
  CHECK(radius_m(20.0f) == doctest::Approx(1.4));
  const auto glow = [](float age_s) { return puff_at(one_particle(false, age_s), 10.0).glow; };
  CHECK(glow(0.0f) == doctest::Approx(0.8));
  CHECK(glow(1.0f) == doctest::Approx(0.4));
  CHECK(glow(3.0f) == 0.0f);
}

TEST_CASE("a puff is whole for seven tenths of its life and gone at its end") {
  const auto area_m2 = [](float age_s) { return puff_at(one_particle(false, age_s), 10.0).extinction_area_m2; };
  CHECK(area_m2(27.9f) == doctest::Approx(0.6));
  CHECK(area_m2(34.0f) == doctest::Approx(0.3));
  std::vector<Puff> puffs;
  add_puffs(one_particle(false, 40.0f), 10.0, puffs);
  CHECK(puffs.empty());
}

TEST_CASE("particles are born evenly in the emitter's ball and one may be owed") {
  Emitter fire;
  fire.position_m = {10.0, 10.0, 10.0};
  fire.radius_m = 2.0;
  fire.rate_per_s = 25'000.0;
  Parameters parameters;
  parameters.most_in_cell = 65535;
  parameters.speed_cells_per_s = parameters.jitter_cells = 0.0;
  State state = make_smoke(make_grid({}, 0.5, 40, 40, 40, 0), {fire}, 3, 20'000, parameters);
  // So short that nothing has moved yet.
  constexpr double step_s = 1e-4;
  advance_smoke(state, Vec3(0.0), {}, step_s);
  CHECK(state.particles.size() == 2);
  CHECK(state.emitters[0].owed == doctest::Approx(0.5));
  state.emitters[0].rate_per_s = 1e8;
  advance_smoke(state, Vec3(0.0), {}, step_s);
  const Particles& p = state.particles;
  REQUIRE(p.size() > 9000);
  double within_half = 0.0;
  Vec3 mean(0.0);
  for (std::size_t n = 0; n < p.size(); ++n) {
    const Vec3 at = 0.5 * Vec3(p.x[n], p.y[n], p.z[n]) - fire.position_m;
    const double r = glm::length(at);
    REQUIRE(r < 2.0 + 1e-5);
    within_half += r < 1.0;
    mean += at;
  }
  const double count = static_cast<double>(p.size());
  CHECK(within_half / count == relative(1.0 / 8.0, 0.1));
  CHECK(glm::length(mean / count) < 0.05);
}

TEST_CASE("a draught moves smoke by its speed whatever the size of the cells") {
  for (const double cell_m : {0.5, 1.0}) {
    CAPTURE(cell_m);
    Emitter none;
    none.heat = 0.0;
    none.lifetime_s = 0.0;
    Parameters parameters;
    parameters.speed_cells_per_s = 0.0;
    State state = make_smoke(make_grid({}, cell_m, 40, 10, 10, 0), {none}, 3, 100, parameters);
    REQUIRE(add_particle(state, {5.5, 5.5, 5.5}, 0));
    for (int n = 0; n < 60; ++n) advance_smoke(state, Vec3(3.0, 0.0, 0.0), {}, 1.0 / 60.0);
    CHECK((state.particles.x[0] - 5.5f) * static_cast<float>(cell_m) == relative(3.0, 0.01));
  }
}

TEST_CASE("a cell lets no more in than it holds and what is pushed finds room elsewhere") {
  Emitter none;
  none.lifetime_s = 0.0;
  State state = make_smoke(make_grid({}, 1.0, 9, 9, 9, 0), {none}, 3);
  for (int n = 0; n < 40; ++n) REQUIRE(add_particle(state, {4.5, 4.5, 4.5}, 0));
  int most = 0;
  for (const std::uint16_t density : state.density) most = std::max<int>(most, density);
  CHECK(most == state.parameters.most_in_cell);
  // A box displaces the smoke in its place.
  const Obstacle box{{{4.5, 4.5, 4.5}, {1, 0, 0, 0}}, Vec3(0.6)};
  const StepReport report = advance_smoke(state, Vec3(0.0), {&box, 1}, 1e-4);
  CHECK(report.pushed >= state.parameters.most_in_cell);
  CHECK(state.density[state.grid.index(4, 4, 4)] == 0);
  CHECK(state.density[state.grid.index(5, 4, 4)] > 0);  // Its face reaches in by a tenth of a cell only.
}

TEST_CASE("walls take soot at the deposition speed and the air loses as much") {
  Emitter none;
  none.heat = 0.0;
  none.lifetime_s = 0.0;
  Parameters parameters;
  parameters.speed_cells_per_s = 0.0;
  parameters.jitter_cells = 0.0;
  const auto soot_after = [&](double deposition_mps) {
    parameters.deposition_mps = 0.0;
    State state = make_smoke(make_grid({}, 1.0, 9, 9, 9, 0), {none}, 3, 5000, parameters);
    // As dense as the crowd everywhere.
    for (int k = 0; k < 9; ++k)
      for (int j = 0; j < 9; ++j)
        for (int i = 0; i < 9; ++i)
          for (int n = 0; n < 5; ++n) REQUIRE(add_particle(state, {i + 0.5, j + 0.5, k + 0.5}, 0));
    for (std::uint64_t tick = 0; tick < extinction_ticks; ++tick) advance_smoke(state, Vec3(0.0), {}, 1.0 / 64.0);
    state.parameters.deposition_mps = deposition_mps;
    for (int tick = 0; tick < 64; ++tick) advance_smoke(state, Vec3(0.0), {}, 1.0 / 64.0);
    double walls_m2 = 0.0;
    for (const float layers : state.soot) walls_m2 += full_layer_depth * static_cast<double>(layers);
    CHECK(state.ledger.on_walls_m2 == relative(walls_m2, 1e-4));
    const double taken_m2 = none.extinction_area_m2 * static_cast<double>(5 * 9 * 9 * 9 - state.particles.size());
    CHECK(taken_m2 + state.ledger.owed_to_walls_m2 == relative(walls_m2, 1e-4));
    CHECK(state.ledger.owed_to_walls_m2 < none.extinction_area_m2);
    for (std::size_t n = 0; n < state.beside_wall.size(); ++n)
      if (static_cast<int>(state.beside_wall[n]) == state.grid.index(4, 4, 0)) return state.soot[n];
    return -1.0f;
  };
  // A wall halves the surroundings: of the ball's layers below the floor there are none.
  const double share = 0.399 + 0.242 + 0.054;
  const double extinction_per_m = 5.0 * none.extinction_area_m2;
  CHECK(soot_after(0.01) == relative(0.01 * extinction_per_m * share * std::pow(0.991, 2) / full_layer_depth, 0.02));
}
