/// Sheets of brittle material, in the grids that their parts have, are pulled in bending as hard as plates are, and
/// break at the same load.

#include "engine/effects/debris/sheet_stress.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/effects/debris/fracture.hpp"
#include "engine/math/gravity.hpp"
#include "engine/physics/elastic/body_measures.hpp"
#include "engine/physics/elastic/step.hpp"
#include "tests/engine/effects/debris/pieces.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::debris;

namespace {

constexpr double bending_step_s = 1.0 / 240.0;

/// A sheet on two supports under its ends, with its weight across it.
struct BentSheet {
  Piece piece;
  int along = 0, wide = 1, across = 2;  ///< Its axes.
  std::vector<elastic::NodeContact> supports;
  std::vector<int> middle;  ///< Nodes above, across the middle of the span.

  double size_m(int axis) const { return part_recipe(piece.part).size_m[axis]; }
};

void find_nodes(BentSheet& bent) {
  bent.supports.clear();
  bent.middle.clear();
  for (int i = 0; i < bent.piece.body.node_count(); ++i) {
    const Eigen::Vector3d& x = bent.piece.body.rest_position_m[static_cast<std::size_t>(i)];
    const double share = std::abs(x[bent.along]) / bent.size_m(bent.along);
    if (x[bent.across] < 0.0 && share > 0.49) {
      elastic::NodeContact support;
      support.node = i;
      support.normal = Eigen::Vector3d::Unit(bent.across);
      bent.supports.push_back(support);
    }
    if (x[bent.across] > 0.0 && share < 0.01) bent.middle.push_back(i);
  }
}

BentSheet on_supports(Part part, std::uint64_t seed) {
  BentSheet bent;
  bent.piece = part_at_rest(part, seed);
  if (part == Part::windscreen) bent.along = 1, bent.wide = 2, bent.across = 0;
  for (auto& x : bent.piece.body.position_m) x.z() -= 2.0;
  find_nodes(bent);
  return bent;
}

/// A step under a line load across the middle: each node has its share of the width.
void step_under(BentSheet& bent, double load_n) {
  auto& body = bent.piece.body;
  const Eigen::Vector3d down = -Eigen::Vector3d::Unit(bent.across);
  for (const int i : bent.middle) {
    const auto node = static_cast<std::size_t>(i);
    const bool at_rim = std::abs(body.rest_position_m[node][bent.wide]) > 0.49 * bent.size_m(bent.wide);
    body.force_n[node] = load_n / (static_cast<double>(bent.middle.size()) - 1.0) * (at_rim ? 0.5 : 1.0) * down;
  }
  for (auto& support : bent.supports)
    support.gap_m =
        body.position_m[static_cast<std::size_t>(support.node)][bent.across] + 0.5 * bent.size_m(bent.across);
  elastic::StepSettings settings;
  settings.step_s = bending_step_s;
  settings.gravity_mps2 = gravity_mps2 * down;
  settings.solver = elastic::Solver::direct;
  settings.keep_stress = true;
  elastic::step_elastic(body, settings, bent.supports);
}

/// Stress below the middle of a plate of the sheet's thickness under this load and its weight.
double plate_stress_pa(const BentSheet& bent, double load_n) {
  const double weight_n = elastic::total_mass_kg(bent.piece.body) * gravity_mps2, span_m = bent.size_m(bent.along);
  const MaterialData& solid = material_data(part_recipe(bent.piece.part).material);
  const double thickness_m =
      bent.size_m(bent.across) * bent.piece.material.elastic.density_kgpm3 / solid.elastic.density_kgpm3;
  const double moment_nm = load_n * span_m / 4.0 + weight_n * span_m / 8.0;
  return 6.0 * moment_nm / (bent.size_m(bent.wide) * thickness_m * thickness_m);
}

/// At which a plate has its strength.
double breaking_load_n(const BentSheet& bent) {
  const double strength_pa = material_data(part_recipe(bent.piece.part).material).strength_pa;
  const double weight_pa = plate_stress_pa(bent, 0.0), newton_pa = plate_stress_pa(bent, 1.0) - weight_pa;
  return (strength_pa - weight_pa) / newton_pa;
}

/// Pieces that it is in when the load has risen for a quarter of a second and has lain for a twentieth.
std::size_t pieces_under(BentSheet bent, double load_n) {
  for (int k = 0; k < 72; ++k) {
    step_under(bent, load_n * std::min(1.0, k / 60.0));
    FractureResult result = fracture(bent.piece, {}, bending_step_s);
    if (result.pieces.size() > 1) return result.pieces.size();
    bent.piece.cracks = std::move(result.cracks);
    if (result.pieces.empty()) continue;
    bent.piece = std::move(result.pieces.front());
    find_nodes(bent);
  }
  return 1;
}

}  // namespace

TEST_CASE("the surface of a sheet on two supports is pulled as hard as a plate's") {
  for (const Part part : {Part::ice_slab, Part::windscreen}) {
    CAPTURE(static_cast<int>(part));
    BentSheet bent = on_supports(part, 1);
    const double load_n = 0.5 * breaking_load_n(bent);
    for (int k = 0; k < 120; ++k) step_under(bent, load_n);
    const auto sheet = sheet_stress(bent.piece);
    REQUIRE(sheet);
    double most_pa = 0.0, greatest_pa = 0.0;
    for (int e = 0; e < static_cast<int>(bent.piece.body.elements.size()); ++e)
      for (const int node : bent.piece.body.elements[static_cast<std::size_t>(e)].nodes)
        for (const Eigen::Matrix3d& stress : surface_stress_pa(*sheet, bent.piece, e, node)) {
          most_pa = std::max(most_pa, stress(bent.along, bent.along));
          greatest_pa = std::max(greatest_pa, stress.norm());
        }
    CHECK(greatest_surface_stress_pa(*sheet) == relative(greatest_pa, 1e-12));
    CHECK(most_pa / sheet->fill == relative(plate_stress_pa(bent, load_n), 0.05));
  }
}

TEST_CASE("a slab of ice on two supports breaks in two within 15 percent of the load of a plate") {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    CAPTURE(seed);
    const BentSheet bent = on_supports(Part::ice_slab, seed);
    const double load_n = breaking_load_n(bent);
    CHECK(load_n == relative(2.7e3, 0.02));
    CHECK(pieces_under(bent, 0.85 * load_n) == 1);
    CHECK(pieces_under(bent, 1.15 * load_n) == 2);
  }
}

TEST_CASE("what bends no brittle sheet has no surface stress") {
  for (const Part part : {Part::barrier_post, Part::door, Part::traffic_cone}) {
    Piece piece = part_at_rest(part);
    piece.body.step_stress_pa.assign(piece.body.elements.size(), 1e6 * Eigen::Matrix3d::Identity());
    CHECK_FALSE(sheet_stress(piece));
  }
  Piece slab = part_at_rest(Part::ice_slab);
  CHECK_FALSE(sheet_stress(slab));  // No step yet.
  // An even pull is no bending.
  slab.body.step_stress_pa.assign(slab.body.elements.size(), 1e6 * Eigen::Matrix3d::Identity());
  const auto sheet = sheet_stress(slab);
  REQUIRE(sheet);
  CHECK(greatest_surface_stress_pa(*sheet) == relative(1e6 * std::sqrt(2.0), 1e-9));
}
