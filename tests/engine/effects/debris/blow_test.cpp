// A contact that is over before the step is.

#include "engine/effects/debris/blow.hpp"

#include <cmath>

#include <doctest/doctest.h>

#include "engine/physics/elastic/body_measures.hpp"
#include "tests/engine/effects/debris/pieces.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::debris;

namespace {

/// One contact of a falling piece's node.
std::vector<FoundContact> falling_on(Piece& piece, double closing_mps, double gap_m) {
  for (auto& v : piece.body.velocity_mps) v = {0, 0, -closing_mps};
  FoundContact found;
  found.contact.node = 0;
  found.contact.gap_m = gap_m;
  return {found};
}

}  // namespace

TEST_CASE("a contact that closes fast returns its share of the speed and is due at once") {
  Piece slab = part_at_rest(Part::ice_slab);
  auto contacts = falling_on(slab, 4.0, 0.03);
  const auto closing = add_restitution(slab, contacts, 0.01);
  REQUIRE(closing.size() == 1);
  CHECK(closing[0] == doctest::Approx(4.0));
  CHECK(contacts[0].contact.surface_velocity_mps.z() == doctest::Approx(0.3 * 4.0));
  CHECK(contacts[0].contact.gap_m == 0.0);
}

TEST_CASE("what is slow or too far off to be met within the step is no blow") {
  Piece slab = part_at_rest(Part::ice_slab);
  for (const auto& [mps, gap_m] : {std::pair(0.9, 0.0), std::pair(4.0, 0.05), std::pair(-4.0, 0.0)}) {
    auto contacts = falling_on(slab, mps, gap_m);
    CHECK(add_restitution(slab, contacts, 0.01)[0] == 0.0);
    CHECK(contacts[0].contact.surface_velocity_mps.z() == 0.0);
    CHECK(contacts[0].contact.gap_m == gap_m);
  }
}

TEST_CASE("a blow loses what restitution does not return and its stress is that of the wave") {
  const Piece slab = part_at_rest(Part::ice_slab);
  constexpr double closing_mps = 6.0, step_s = 0.01, e = 0.3;
  const double mass_kg = elastic::total_mass_kg(slab.body);
  std::vector<elastic::NodeContact> contacts(2);
  contacts[0].impulse_ns = {3.0, 0.0,
                            // A quarter of it; friction is not part of the impact.
                            0.25 * (1.0 + e) * mass_kg * closing_mps};
  contacts[1].impulse_ns = {0.0, 0.0, 0.75 * (1.0 + e) * mass_kg * closing_mps};
  contacts[1].node = 1;
  const std::vector<double> closing{closing_mps, closing_mps};
  const Blow blow = blow_of(slab, contacts, closing, step_s);
  CHECK(blow.lost_j == relative(0.5 * mass_kg * closing_mps * closing_mps * (1.0 - e * e), 1e-6));
  CHECK((blow.normal - Eigen::Vector3d::UnitZ()).norm() < 1e-9);
  // One element thick, so that its mean is half of the surface's: twice Δt c / ((1 + e) L).
  const auto& m = slab.material.elastic;
  const double wave_mps = std::sqrt(m.young_modulus_pa / m.density_kgpm3),
               thick_m = part_recipe(Part::ice_slab).size_m.z;
  CHECK(blow.stress_factor == relative(2.0 * step_s * wave_mps / ((1.0 + e) * thick_m), 1e-6));
  // Contacts that are no impact, or pull, do not count.
  const std::vector<double> pressing{0.0, 0.0};
  CHECK(blow_of(slab, contacts, pressing, step_s).lost_j == 0.0);
  CHECK(blow_of(slab, contacts, pressing, step_s).stress_factor == 1.0);
}

TEST_CASE("fragments are scattered across the blow with the energy that is given and turn nothing") {
  std::vector<Piece> fragments;
  for (const double angle : {0.3, 2.0, 4.4}) {
    Piece lamp = part_at_rest(Part::lamp, static_cast<std::uint64_t>(10.0 * angle));
    for (int i = 0; i < lamp.body.node_count(); ++i) {
      lamp.body.position_m[i] += Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.1 * angle);
      lamp.body.velocity_mps[i] = {1.0, -2.0, 0.5};
    }
    fragments.push_back(lamp);
  }
  const auto sums = [&] {
    double energy = 0.0;
    Eigen::Vector3d momentum = Eigen::Vector3d::Zero(), spin = momentum;
    for (const Piece& p : fragments) {
      energy += elastic::kinetic_energy_j(p.body);
      momentum += elastic::momentum_ns(p.body);
      spin += elastic::angular_momentum_nms(p.body);
    }
    return std::tuple(energy, momentum, spin);
  };
  const auto [energy, momentum, spin] = sums();
  scatter(fragments, Eigen::Vector3d::UnitZ(), 12.0);
  const auto [energy_after, momentum_after, spin_after] = sums();
  CHECK(energy_after - energy == relative(12.0, 1e-6));
  CHECK((momentum_after - momentum).norm() < 1e-9);
  CHECK((spin_after - spin).norm() < 1e-9);
  for (const Piece& p : fragments) {
    const Eigen::Vector3d away = elastic::centre_of_mass_m(p.body),
                          moved = elastic::momentum_ns(p.body) / elastic::total_mass_kg(p.body);
    CHECK((moved - Eigen::Vector3d(1.0, -2.0, 0.5)).head<2>().dot(away.head<2>()) > 0.0);
    CHECK(std::abs(moved.z() - 0.5) < 0.4 * (moved - Eigen::Vector3d(1.0, -2.0, 0.5)).norm());
  }
}

TEST_CASE("fragments that lie above each other in the blow's direction are not driven along it") {
  std::vector<Piece> fragments;
  for (const double side : {-1.0, 1.0})
    for (const double up : {-1.0, 1.0}) {
      Piece lamp = part_at_rest(Part::lamp);
      for (auto& x : lamp.body.position_m) x += Eigen::Vector3d(side, 0.0, up);
      fragments.push_back(lamp);
    }
  scatter(fragments, Eigen::Vector3d::UnitZ(), 3.0);
  for (const Piece& p : fragments) {
    const Eigen::Vector3d moved = elastic::momentum_ns(p.body) / elastic::total_mass_kg(p.body);
    CHECK(moved.norm() > 0.1);
    CHECK(std::abs(moved.z()) < 1e-9 * moved.norm());
  }
}
