#include <doctest/doctest.h>

#include "engine/effects/smoke/attraction.hpp"
#include "engine/effects/smoke/visibility.hpp"
#include "smoke_fixtures.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::smoke;

namespace {

std::uint64_t hash_of(const State& state) {
  StateHash hash;
  add_to_hash(state, hash);
  return hash.value();
}

}  // namespace

TEST_CASE("the pattern has 46 samples whose levels weigh as the paper says") {
  std::array<double, 3> weight{};
  Vec3 sum(0.0);
  for (const SampleOffset& s : sample_pattern()) {
    const int level = std::max({std::abs(s.x), std::abs(s.y), std::abs(s.z)});
    weight[level - 1] += glm::length(Vec3(s.x, s.y, s.z));
    sum += Vec3(s.x, s.y, s.z);
  }
  CHECK(weight[0] == relative(36.8, 0.002));
  CHECK(weight[1] == relative(39.7, 0.002));
  CHECK(weight[2] == doctest::Approx(18.0));
  CHECK(sum == Vec3(0.0));
}

TEST_CASE("attraction is one in an empty cell and none at the crowd and minus one beyond twice it") {
  const Parameters parameters;
  CHECK(attraction(0.0, parameters) == 1.0);
  CHECK(attraction(5.0, parameters) == 0.0);
  CHECK(attraction(10.0, parameters) == -1.0);
  CHECK(attraction(200.0, parameters) == -1.0);
  CHECK(attraction_table(parameters).size() == 11);
}

TEST_CASE("the convolution of the cells equals the samples of the particles") {
  State state = tunnel_fire(3, 4000);
  const Obstacle lorry{state.grid.world_from_grid * RigidTransform{{70.0, 5.0, 2.0}}, {8.0, 1.3, 2.0}};
  for (int tick = 0; tick < 60; ++tick) advance_smoke(state, Vec3(0.0), {&lorry, 1}, step_s);
  const auto table = attraction_table(state.parameters);
  update_velocity_field(state, table, state.field);
  int compared = 0;
  for (int k = 0; k < state.grid.nz; ++k)
    for (int j = 0; j < state.grid.ny; ++j)
      for (int i = 0; i < state.grid.nx; ++i) {
        const int cell = state.grid.index(i, j, k);
        if (state.density[cell] == 0) continue;
        const double bias = 1.37;
        const Vec3 expected = mean_sample(state, table, i, j, k, bias) * state.parameters.speed_cells_per_s;
        const CellVelocity& v = state.field.cells[cell];
        for (int c = 0; c < 3; ++c)
          REQUIRE(std::abs(velocity_quantum * (v.rest[c] + bias * v.above[c]) - expected[c]) <=
                  0.51 * velocity_quantum * (1.0 + bias) + 1e-4);
        ++compared;
      }
  CHECK(compared > 100);
}

TEST_CASE("no smoke is in a wall or a vehicle and none is lost") {
  State state = tunnel_fire(1, 3000);
  state.grid.open_faces = 0;
  state = make_smoke(state.grid, state.emitters, 1, 3000);
  state.emitters[0].lifetime_s = 0.0;
  state.parameters.deposition_mps = 0.0;
  std::array<Obstacle, 2> lorries;
  const Vec3 draught = state.grid.world_from_grid.orientation * Vec3(2.0, 0.5, 0.0);
  int born = 0, pushed = 0;
  for (int tick = 0; tick < 480; ++tick) {
    // Two lorries drive through the smoke, one each way.
    const double x = 30.0 + 20.0 * tick * step_s;
    lorries[0] = {state.grid.world_from_grid * RigidTransform{{x, 4.0, 2.0}}, {8.0, 1.25, 2.0}};
    lorries[1] = {state.grid.world_from_grid * RigidTransform{{120.0 - x, 8.0, 2.0}}, {8.0, 1.25, 2.0}};
    const StepReport report = advance_smoke(state, draught, lorries, step_s);
    born += report.born;
    pushed += report.pushed;
    REQUIRE(report.left == 0);
    if (tick % 20 == 0) REQUIRE(particles_in_full_cells(state) == 0);
  }
  int stands_for = 0;
  for (const std::uint16_t births : state.particles.births) stands_for += births;
  CHECK(stands_for == born);
  CHECK(born == 4800);
  CHECK(state.refused == 0);
  CHECK(state.particles.size() <= 3000);
  CHECK(pushed > 0);
  int counted = 0;
  for (const std::uint16_t density : state.density) counted += density;
  CHECK(counted == static_cast<int>(state.particles.size()));
}

TEST_CASE("particles die at the end of their life and their numbers are used again") {
  State state = tunnel_fire(1, 20000);
  state.emitters[0].lifetime_s = 0.5;
  for (int tick = 0; tick < 120; ++tick) advance_smoke(state, Vec3(0.0), {}, step_s);
  CHECK(state.particles.size() == relative(300, 0.05));
  CHECK(state.particles.numbers < 330);
  state.emitters[0].rate_per_s = 0.0;
  for (int tick = 0; tick < 40; ++tick) advance_smoke(state, Vec3(0.0), {}, step_s);
  CHECK(state.particles.size() == 0);
}

TEST_CASE("the same seed gives the same smoke and another seed another") {
  State first = tunnel_fire(7, 2000), second = tunnel_fire(7, 2000), other = tunnel_fire(8, 2000);
  for (int tick = 0; tick < 120; ++tick)
    for (State* state : {&first, &second, &other}) advance_smoke(*state, Vec3(0.3, 0.0, 0.0), {}, step_s);
  CHECK(hash_of(first) == hash_of(second));
  CHECK(hash_of(first) != hash_of(other));
}

TEST_CASE("a line of sight loses light by the cross-sections of the cells that it passes") {
  State state = make_smoke(make_grid({}, 0.5, 20, 10, 10, 0), {Emitter{}}, 1);
  state.extinction_area_m2.assign(state.extinction_area_m2.size(), 0.05f);
  const double extinction = 0.05 / 0.125;
  CHECK(extinction_per_m(state, {5.0, 2.0, 2.0}) == doctest::Approx(extinction));
  CHECK(extinction_per_m(state, {-0.1, 2.0, 2.0}) == 0.0);
  const Vec3 from(1.0, 1.1, 1.3), to(8.2, 4.0, 3.1);
  CHECK(transmittance(state, from, to) == relative(std::exp(-extinction * glm::length(to - from)), 1e-6));
  CHECK(transmittance(state, to, from) == doctest::Approx(transmittance(state, from, to)));
  // Only the part inside counts: 10 m of smoke along x.
  CHECK(transmittance(state, {-50.0, 2.3, 2.3}, {90.0, 2.3, 2.3}) == relative(std::exp(-extinction * 10.0), 1e-6));
  CHECK(transmittance(state, {-50.0, 9.0, 2.3}, {90.0, 9.0, 2.3}) == 1.0);
  CHECK(optical_depth(state, from, to) == relative(extinction * glm::length(to - from), 1e-6));
  // Depth 2 lies 2/0.4 m behind the face at which the line comes in; of 4 the box has none.
  CHECK(*distance_of_depth_m(state, {-50.0, 2.3, 2.3}, {90.0, 2.3, 2.3}, 2.0) == relative(55.0, 1e-6));
  CHECK(!distance_of_depth_m(state, {-50.0, 2.3, 2.3}, {90.0, 2.3, 2.3}, 4.1));
  CHECK(*visibility_m(0.4, false) == doctest::Approx(7.5));
  CHECK(*visibility_m(0.4, true) == doctest::Approx(20.0));
  CHECK(!visibility_m(0.0, true));
}

TEST_CASE("a cell is a wall where its middle is") {
  Grid grid = make_grid({{10.0, 0.0, 0.0}, {1, 0, 0, 0}}, 0.5, 8, 4, 4, 0);
  add_walls(grid, [](const Vec3& world_m) { return world_m.x > 12.2; });
  for (int i = 0; i < 8; ++i) CHECK(int{grid.wall[grid.index(i, 1, 1)]} == int{10.0 + 0.5 * (i + 0.5) > 12.2});
}

TEST_CASE("a body fills the cells whose middle it covers or misses by no more than a quarter of a cell") {
  const auto full_cells = [](double half_size_m) {
    State state = make_smoke(make_grid({}, 1.0, 9, 9, 9, 0), {Emitter{}}, 3);
    const Obstacle box{{{4.5, 4.5, 4.5}, {1, 0, 0, 0}}, Vec3(half_size_m)};
    advance_smoke(state, Vec3(0.0), {&box, 1}, step_s);
    return std::count(state.full.begin(), state.full.end(), 1);
  };
  CHECK(full_cells(0.7) == 1);
  CHECK(full_cells(0.8) == 27);
  CHECK(full_cells(1.7) == 27);
  CHECK(full_cells(1.8) == 125);
}

TEST_CASE("smoke leaves by the face that is open and by no other") {
  const auto left_with_wind = [](const Vec3& wind_mps, std::uint8_t open_faces) {
    Emitter fire;
    fire.position_m = {4.5, 4.5, 4.5};
    fire.radius_m = 1.0;
    fire.rate_per_s = 300.0;
    State state = make_smoke(make_grid({}, 1.0, 9, 9, 9, open_faces), {fire}, 3, 1000);
    int left = 0;
    for (int tick = 0; tick < 60; ++tick) left += advance_smoke(state, wind_mps, {}, step_s).left;
    return left;
  };
  const struct {
    Vec3 wind_mps;
    std::uint8_t towards, away;
  } winds[] = {{{25, 0, 0}, open_x_high, open_x_low}, {{-25, 0, 0}, open_x_low, open_x_high},
               {{0, 25, 0}, open_y_high, open_y_low}, {{0, -25, 0}, open_y_low, open_y_high},
               {{0, 0, 25}, open_z_high, open_z_low}, {{0, 0, -25}, open_z_low, open_z_high}};
  for (const auto& [wind_mps, towards, away] : winds) {
    CHECK(left_with_wind(wind_mps, towards) > 10);
    CHECK(left_with_wind(wind_mps, away) == 0);
  }
}
