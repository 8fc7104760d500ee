/// Each account of the ledger has what it says.

#include "engine/effects/debris/energy_ledger.hpp"

#include <cmath>

#include <doctest/doctest.h>

#include "engine/effects/debris/energy_bound.hpp"
#include "engine/effects/debris/fracture.hpp"
#include "tests/engine/effects/debris/ledger_scenes.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::debris;

namespace {

constexpr double frame_s = 1.0 / 60.0;

}  // namespace

TEST_CASE("debris moves to the bit as it does without a ledger") {
  Scene with = scenes::door_bent(), without = scenes::door_bent();
  EnergyLedger ledger;
  for (int k = 0; k < 20; ++k) {
    advance(with, k * frame_s, frame_s, &ledger);
    advance(without, k * frame_s, frame_s, nullptr);
  }
  REQUIRE(with.state.pieces.size() == without.state.pieces.size());
  for (std::size_t p = 0; p < with.state.pieces.size(); ++p) {
    CHECK(with.state.pieces[p].body.position_m == without.state.pieces[p].body.position_m);
    CHECK(with.state.pieces[p].body.velocity_mps == without.state.pieces[p].body.velocity_mps);
  }
  CHECK(ledger.plastic_loss_j > 0.0);
}

TEST_CASE("what slides to a stop has lost its motion by friction") {
  Scene scene;
  scenes::put(scene, Part::lamp, {{0, 0, 0.5 * part_recipe(Part::lamp).size_m.z}, {1, 0, 0, 0}}, {0, 3, 0});
  const StoredEnergy start = stored_energy(scene.state);
  EnergyLedger ledger;
  for (int k = 0; k < 120; ++k) advance(scene, k * frame_s, frame_s, &ledger);
  CHECK(start.kinetic_j == relative(0.5 * part_recipe(Part::lamp).mass_kg * 9.0, 1e-9));
  CHECK(ledger.friction_loss_j == relative(start.kinetic_j, 0.05));
  CHECK(ledger.box_work_j == 0.0);
}

TEST_CASE("flow and cracks take from an impact no more than it has lost") {
  Scene scene = scenes::door_bent();
  const StoredEnergy start = stored_energy(scene.state);
  EnergyLedger ledger;
  for (int k = 0; k < 40; ++k) {
    advance(scene, k * frame_s, frame_s, &ledger);
    CHECK(ledger.pressing_loss_j > -0.005 * start.kinetic_j);
  }
  CHECK(ledger.plastic_loss_j > 0.1 * start.kinetic_j);
  CHECK(ledger.plastic_loss_j + ledger.fracture_loss_j < start.kinetic_j);
}

TEST_CASE("faces that a pull opens take their cracks' energy from what it has stretched") {
  Piece post = part_at_rest(Part::barrier_post);
  for (auto& x : post.body.position_m) x.z() = 2.0 + (x.z() - 2.0) * 1.0005;  // Five times its strength.
  const double before_j = stored_energy(post).sum_j();
  FractureResult result = fracture(post);
  REQUIRE(result.opened_faces > 0);
  CHECK(result.paid_j == 0.0);
  CHECK(result.cracked_j > 1.0);
  take_from_deformation(result.pieces, result.cracked_j);
  double after_j = 0.0;
  for (const Piece& piece : result.pieces) after_j += stored_energy(piece).sum_j();
  CHECK(before_j - after_j == relative(result.cracked_j, 0.01));
}

TEST_CASE("what melts takes its energy with it") {
  Scene scene;
  scenes::put(scene, Part::ice_slab, {{0, 0, 1.0}, {1, 0, 0, 0}}, {5, 0, 0});
  scene.world.melted_m = 1e-4;
  const StoredEnergy start = stored_energy(scene.state);
  EnergyLedger ledger;
  for (int k = 0; k < 20; ++k) advance(scene, k * frame_s, frame_s, &ledger);
  CHECK(ledger.melting_loss_j == relative((start.kinetic_j + start.potential_j) * 20 * 1e-4 / 0.08, 0.1));
  CHECK(std::abs(unexplained_j(start, stored_energy(scene.state), ledger)) < 1e-6 * start.kinetic_j);
}
