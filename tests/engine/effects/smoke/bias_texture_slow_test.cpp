/// The bias texture and the cooling as published beside ours, and the paper's warning of large cells and near births.

#include <array>
#include <cmath>
#include <cstdint>

#include <doctest/doctest.h>

#include "engine/effects/smoke/attraction.hpp"
#include "tests/engine/effects/smoke/bias_texture.hpp"
#include "tests/engine/effects/smoke/smoke_fixtures.hpp"

using namespace septet;
using namespace septet::smoke;

namespace {

/// Ten rows that last a second each: the emitter's cooling time.
constexpr int rows = 11, ticks_a_row = 60;

State published_room() {
  State state = paper_room();
  state.parameters.most_in_cell = 65535;
  return state;
}

Layers after(State state, int ticks, Cooling cooling) {
  const BiasTexture texture = bias_texture(rows, state.emitters[0].heat);
  CooledTicks cooled;
  for (int tick = 0; tick < ticks; ++tick) advance_with_texture(state, texture, cooling, ticks_a_row, cooled, step_s);
  return layers_of(state);
}

/// The paper's room, 24 × 24 × 16 m, with cells of another size: speed in metres and births are as they were.
State room_of_cells(double cell_m, double birth_radius_m) {
  const State usual = paper_room();
  Parameters parameters = usual.parameters;
  parameters.speed_cells_per_s /= cell_m;
  Emitter fire = usual.emitters[0];
  fire.radius_m = birth_radius_m;
  const auto cells = [&](double length_m) { return static_cast<int>(std::lround(length_m / cell_m)); };
  return make_smoke(make_grid({}, cell_m, cells(24.0), cells(24.0), cells(16.0), 0), {fire}, 1, 20000, parameters);
}

Layers ten_seconds(State state, bool published) {
  if (published) state.parameters.most_in_cell = 65535;
  for (int tick = 0; tick < 600; ++tick) {
    if (published)
      advance_smoke_literally(state, step_s);
    else
      advance_smoke(state, Vec3(0.0), {}, step_s);
  }
  return layers_of(state);
}

}  // namespace

TEST_CASE("a bias texture that is read by age is the formula of the age") {
  const std::array<int, 3> ticks{60, 600, 3000};
  const std::array<double, 3> by_formula{0.32, 0.68, 0.54};  // advance_smoke_literally in the same room.
  for (std::size_t n = 0; n < ticks.size(); ++n)
    CHECK(std::abs(after(published_room(), ticks[n], Cooling::by_age).mean - by_formula[n]) < 0.02);
}

TEST_CASE("smoke that cools in thin surroundings alone stays under the ceiling where that of its age fills the room") {
  const Layers by_age = after(published_room(), 3000, Cooling::by_age),
               in_thin = after(published_room(), 3000, Cooling::in_thin_smoke);
  CHECK(by_age.mean < 0.57);
  CHECK(by_age.quarters[0] > 0.15);
  CHECK(in_thin.mean > 0.65);
  CHECK(in_thin.quarters[3] > 0.55);
}

TEST_CASE("cells of two metres and more keep smoke from the ceiling of a room of 16 m") {
  for (const bool published : {true, false}) {
    CAPTURE(published);
    CHECK(ten_seconds(room_of_cells(1.0, 1.0), published).mean > 0.64);
    CHECK(ten_seconds(room_of_cells(2.0, 1.0), published).mean < 0.52);
  }
  CHECK(ten_seconds(room_of_cells(4.0, 1.0), true).quarters[3] < 0.02);
}

TEST_CASE("births at a point clump as published and not in Septet's update") {
  const Layers published = ten_seconds(room_of_cells(1.0, 0.0), true),
               ours = ten_seconds(room_of_cells(1.0, 0.0), false);
  CHECK(published.most > 1000);
  CHECK(published.quarters[3] < 0.3);
  CHECK(ours.most <= 12);
  CHECK(ours.quarters[3] > 0.35);
  // A third of a cell is enough.
  CHECK(ten_seconds(room_of_cells(1.0, 0.3), true).quarters[3] > 0.4);
}
