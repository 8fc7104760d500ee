#include <algorithm>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "engine/effects/debris/debris_state.hpp"
#include "engine/effects/debris/fracture.hpp"
#include "engine/effects/debris/melt.hpp"
#include "engine/effects/debris/piece.hpp"
#include "engine/effects/debris/save_debris.hpp"
#include "engine/math/gravity.hpp"
#include "engine/physics/elastic/body_measures.hpp"
#include "tests/engine/effects/debris/pieces.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::debris;

namespace {

/// A slab that a pull has broken; its pieces sleep.
State broken_slab() {
  Piece slab = part_at_rest(Part::ice_slab);
  for (auto& x : slab.body.position_m) x.x() *= 1.001;
  State state;
  state.pieces = fracture(slab).pieces;
  REQUIRE(state.pieces.size() > 3);
  for (Piece& piece : state.pieces) {
    piece.id = state.next_id++;
    piece.asleep = true;
  }
  return state;
}

double volume_m3(const Piece& piece) {
  double sum = 0.0;
  for (const auto& element : piece.body.elements) sum += element.rest_volume_m3;
  return sum;
}

double lowest_m(const Piece& piece) {
  return std::ranges::min(piece.body.position_m, {}, [](const Eigen::Vector3d& x) { return x.z(); }).z();
}

/// Kinetic, elastic and of its height.
double energy_j(const Piece& piece) {
  const auto& body = piece.body;
  return elastic::kinetic_energy_j(body) + elastic::elastic_energy_j(body) +
         gravity_mps2 * elastic::total_mass_kg(body) * elastic::centre_of_mass_m(body).z();
}

}  // namespace

TEST_CASE("each piece of a slab loses its share of the thickness that melts and stays on what it lies on") {
  State state = broken_slab();
  const std::vector<Piece> before = state.pieces;
  constexpr double whole_m = 0.08, melted_m = 3.3e-3;
  constexpr int ticks = 216'000;  // Of an hour, in each of which a surface loses 15 nm.
  for (int k = 0; k < ticks; ++k) melt_ice(state, melted_m / ticks);
  REQUIRE(state.pieces.size() == before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Piece& piece = state.pieces[i];
    const double mass_kg = elastic::total_mass_kg(before[i].body), lost_kg = melted_m / whole_m * mass_kg;
    CHECK(mass_kg - elastic::total_mass_kg(piece.body) == relative(lost_kg, 0.01));
    CHECK(volume_m3(piece) * piece.material.elastic.density_kgpm3 ==
          relative(elastic::total_mass_kg(piece.body), 1e-9));
    CHECK(lowest_m(piece) == relative(lowest_m(before[i]), 1e-9));
    CHECK_FALSE(piece.asleep);  // It woke at the first millimetre.
  }
}

TEST_CASE("nothing melts without heat and nothing but ice with it") {
  State state = broken_slab();
  Piece cone = part_at_rest(Part::traffic_cone);
  cone.id = state.next_id++;
  state.pieces.push_back(cone);
  const std::vector<Piece> before = state.pieces;
  melt_ice(state, 0.0);
  for (std::size_t i = 0; i < before.size(); ++i) CHECK(state.pieces[i].body.mass_kg == before[i].body.mass_kg);
  melt_ice(state, 0.04);
  CHECK(elastic::total_mass_kg(state.pieces.front().body) < 0.51 * elastic::total_mass_kg(before.front().body));
  CHECK(state.pieces.back().body.mass_kg == cone.body.mass_kg);
  CHECK(state.pieces.back().body.position_m == cone.body.position_m);
}

TEST_CASE("ice thinner than a tenth of its height has run off and sleepers wake by the millimetre") {
  State state = broken_slab();
  melt_ice(state, 0.5e-3);  // From 80 mm to 79.5.
  for (Piece& piece : state.pieces) piece.asleep = true;
  melt_ice(state, 0.3e-3);
  CHECK(std::ranges::all_of(state.pieces, &Piece::asleep));
  melt_ice(state, 0.3e-3);
  CHECK(std::ranges::none_of(state.pieces, &Piece::asleep));
  melt_ice(state, 0.0708);  // 8.1 mm are left.
  CHECK_FALSE(state.pieces.empty());
  melt_ice(state, 0.2e-3);
  CHECK(state.pieces.empty());
}

TEST_CASE("a slab that is bent, turns and melts gains no energy") {
  for (const double bend_m : {0.0, 2e-3, -2e-3}) {
    State state;
    state.pieces.push_back(part_at_rest(Part::ice_slab));
    auto& body = state.pieces.front().body;
    for (int i = 0; i < body.node_count(); ++i) {
      auto& x = body.position_m[i];
      body.velocity_mps[i] = {-x.y(), x.x(), 0.5 * x.x()};
      x.z() += bend_m * x.x() * x.x();
      x.x() *= 1.0 - 1e-4 * x.y();
    }
    double last_j = energy_j(state.pieces.front()), stored_j = elastic::elastic_energy_j(body);
    REQUIRE((stored_j > 1.0));
    for (int k = 0; k < 60; ++k) {
      melt_ice(state, 1e-3);
      const double now_j = energy_j(state.pieces.front()),
                   kept_j = elastic::elastic_energy_j(state.pieces.front().body);
      CHECK(now_j < last_j);
      CHECK(kept_j < stored_j);
      last_j = now_j;
      stored_j = kept_j;
    }
  }
}

TEST_CASE("fragments of ice that has melted in part go on from its height") {
  Piece slab = part_at_rest(Part::ice_slab);
  slab.height_m = 0.05;
  slab.melted_m = 4e-6;
  for (auto& x : slab.body.position_m) x.x() *= 1.001;
  for (const Piece& piece : fracture(slab).pieces) {
    CHECK(piece.height_m == 0.05);
    CHECK(piece.melted_m == 4e-6);
  }
}

TEST_CASE("a saved state goes on melting alike and one of more ice than its part had is refused") {
  State state = broken_slab();
  melt_ice(state, 2e-3);
  melt_ice(state, 7e-6);  // Which the shape does not show yet.
  const auto restored = [](const State& from) {
    Bytes bytes;
    StateWriter writer(bytes);
    save_debris(from, writer);
    StateReader reader(bytes);
    State again;
    restore_debris(reader, again);
    return reader.ok() ? again : State{};
  };
  State again = restored(state);
  REQUIRE(again.pieces.size() == state.pieces.size());
  for (State* each : {&state, &again}) melt_ice(*each, 4e-6);
  for (std::size_t i = 0; i < state.pieces.size(); ++i) {
    CHECK(again.pieces[i].height_m == state.pieces[i].height_m);
    CHECK(again.pieces[i].body.position_m == state.pieces[i].body.position_m);
  }
  state.pieces.front().height_m = 0.081;
  CHECK(restored(state).pieces.empty());
}
