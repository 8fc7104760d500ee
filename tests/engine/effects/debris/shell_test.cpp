/// A door is a sheet: on its own grid it bends, stretches, flows and breaks as a steel plate of its thickness does.

#include "engine/physics/elastic/shell.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include <doctest/doctest.h>

#include "engine/effects/debris/fracture.hpp"
#include "engine/effects/debris/save_debris.hpp"
#include "engine/physics/elastic/body_measures.hpp"
#include "engine/physics/elastic/step.hpp"
#include "tests/engine/effects/debris/pieces.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::debris;

namespace {

/// Across it is y.
struct Sheet {
  Piece piece = part_at_rest(Part::door);
  int along = 0, wide = 2;

  const PartRecipe& recipe() const { return part_recipe(Part::door); }
  double length_m() const { return recipe().size_m[along]; }
  double width_m() const { return recipe().size_m[wide]; }
  double thickness_m() const { return recipe().sheet_m; }
  double share_along(int node) const {
    return piece.body.rest_position_m[static_cast<std::size_t>(node)][along] / length_m() + 0.5;
  }
  bool at(int node, double share) const { return std::abs(share_along(node) - share) < 1e-6; }
};

Sheet sheet_along(int axis) {
  Sheet sheet;
  sheet.along = axis;
  sheet.wide = 2 - axis;
  return sheet;
}

/// A force spread over the nodes of a line across, by the width that each stands for.
void load_line(Sheet& sheet, double share, const Eigen::Vector3d& force_n) {
  auto& body = sheet.piece.body;
  const double cells = sheet.recipe().cells[sheet.wide];
  for (int i = 0; i < body.node_count(); ++i) {
    if (!sheet.at(i, share)) continue;
    const auto node = static_cast<std::size_t>(i);
    const bool at_rim = std::abs(body.rest_position_m[node][sheet.wide]) > 0.49 * sheet.width_m();
    body.force_n[node] += 0.5 / cells * (at_rim ? 0.5 : 1.0) * force_n;  // Two nodes across the sheet.
  }
}

/// Mean way of the nodes on a line.
Eigen::Vector3d way_m(const Sheet& sheet, double share, const std::vector<Eigen::Vector3d>& start_m) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;
  for (int i = 0; i < sheet.piece.body.node_count(); ++i)
    if (sheet.at(i, share)) {
      const auto node = static_cast<std::size_t>(i);
      sum += sheet.piece.body.position_m[node] - start_m[node], ++count;
    }
  return sum / count;
}

/// Steps without weight, long beside all periods, until it lies still.
void settle(Piece& piece, int steps = 40, std::span<elastic::NodeContact> supports = {}) {
  elastic::StepSettings settings;
  settings.step_s = 0.5;
  settings.damping_ratio = 0.5;
  settings.gravity_mps2.setZero();
  settings.solver = elastic::Solver::direct;
  settings.follow_spin = false;
  settings.keep_stress = true;
  for (int k = 0; k < steps; ++k) {
    std::ranges::fill(piece.body.velocity_mps, Eigen::Vector3d::Zero());
    elastic::step_elastic(piece.body, settings, supports);
  }
}

void clamp(Sheet& sheet, double share) {
  for (int i = 0; i < sheet.piece.body.node_count(); ++i)
    if (sheet.at(i, share)) sheet.piece.body.fixed[static_cast<std::size_t>(i)] = 1;
}

double young_pa() { return material_data(Material::steel_sheet).elastic.young_modulus_pa; }

/// EI of a beam as wide as the sheet.
double beam_nm2(const Sheet& sheet) { return young_pa() * sheet.width_m() * std::pow(sheet.thickness_m(), 3) / 12.0; }

/// Deflection of the free end of a clamped sheet over that of Euler's and Bernoulli's beam.
double cantilever_ratio(int axis) {
  Sheet sheet = sheet_along(axis);
  const double expected_m = 1e-4;
  const double force_n = expected_m * 3.0 * beam_nm2(sheet) / std::pow(sheet.length_m(), 3);
  const auto start_m = sheet.piece.body.position_m;
  clamp(sheet, 0.0);
  load_line(sheet, 1.0, {0.0, force_n, 0.0});
  settle(sheet.piece);
  return way_m(sheet, 1.0, start_m).y() / expected_m;
}

/// Deflection of the middle of a sheet pressed there towards two smooth supports under its ends, over that of a beam.
double pressed_ratio() {
  Sheet sheet = sheet_along(0);
  const double expected_m = 1e-4;
  const double force_n = expected_m * 48.0 * beam_nm2(sheet) / std::pow(sheet.length_m(), 3);
  const auto start_m = sheet.piece.body.position_m;
  std::vector<elastic::NodeContact> supports;
  for (int i = 0; i < sheet.piece.body.node_count(); ++i) {
    if (!sheet.at(i, 0.0) && !sheet.at(i, 1.0)) continue;
    if (!(sheet.piece.body.rest_position_m[static_cast<std::size_t>(i)].y() < 0.0)) continue;
    supports.emplace_back().node = i;
    supports.back().normal = Eigen::Vector3d::UnitY();
  }
  load_line(sheet, 0.5, {0.0, -force_n, 0.0});
  for (int k = 0; k < 80; ++k) {
    for (auto& support : supports) {
      const auto node = static_cast<std::size_t>(support.node);
      support.gap_m = sheet.piece.body.position_m[node].y() - start_m[node].y();
    }
    settle(sheet.piece, 1, supports);
  }
  const double ends_m = 0.5 * (way_m(sheet, 0.0, start_m).y() + way_m(sheet, 1.0, start_m).y());
  return (ends_m - way_m(sheet, 0.5, start_m).y()) / expected_m;
}

/// Stretch of the clamped sheet along an axis over that of a strip.
double pull_ratio(int axis) {
  Sheet sheet = sheet_along(axis);
  const double expected_m = 1e-5;
  const double force_n = expected_m / sheet.length_m() * young_pa() * sheet.width_m() * sheet.thickness_m();
  const auto start_m = sheet.piece.body.position_m;
  clamp(sheet, 0.0);
  load_line(sheet, 1.0, force_n * Eigen::Vector3d::Unit(axis));
  settle(sheet.piece);
  return way_m(sheet, 1.0, start_m)[axis] / expected_m;
}

/// Lays the sheet round a drum of this curvature: along it every cell is as long as before, a chord.
void bend_round_drum(Sheet& sheet, double curvature_1pm) {
  auto& body = sheet.piece.body;
  const double cell_m = sheet.length_m() / sheet.recipe().cells[sheet.along], radius_m = 1.0 / curvature_1pm;
  const double turn_rad = 2.0 * std::asin(0.5 * cell_m * curvature_1pm);
  for (std::size_t i = 0; i < body.position_m.size(); ++i) {
    const Eigen::Vector3d& rest_m = body.rest_position_m[i];
    const double angle_rad = turn_rad * rest_m[sheet.along] / cell_m;
    const double out_m = radius_m + rest_m.y();
    body.position_m[i] = {0.0, out_m * std::cos(angle_rad), 0.0};
    body.position_m[i][sheet.along] = out_m * std::sin(angle_rad);
    body.position_m[i][sheet.wide] = rest_m[sheet.wide];
  }
}

/// Curvature from end to end, by the turn of the lines across at both.
double curvature_1pm(const Sheet& sheet) {
  const auto& body = sheet.piece.body;
  std::array<Eigen::Vector3d, 2> out{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  for (int i = 0; i < body.node_count(); ++i)
    for (std::size_t end = 0; end < 2; ++end)
      if (sheet.at(i, static_cast<double>(end))) {
        const auto node = static_cast<std::size_t>(i);
        out[end] += (body.rest_position_m[node].y() > 0.0 ? 1.0 : -1.0) * body.position_m[node];
      }
  return std::acos(std::clamp(out[0].normalized().dot(out[1].normalized()), -1.0, 1.0)) / sheet.length_m();
}

/// At which the section of a wide steel plate flows through: von Mises of M and νM is σt²/4.
double flowing_curvature_1pm(const Sheet& sheet) {
  const MaterialData& steel = material_data(Material::steel_sheet);
  const double nu = steel.elastic.poisson_ratio, t = sheet.thickness_m();
  const double bending_nm = young_pa() * std::pow(t, 3) / (12.0 * (1.0 - nu * nu));
  return 0.25 * steel.yield_pa * t * t / (bending_nm * std::sqrt(1.0 - nu + nu * nu));
}

}  // namespace

TEST_CASE("a clamped door bends under a load at its end as a plate of its thickness does") {
  CHECK(cantilever_ratio(0) == relative(1.0, 0.10));
  CHECK(cantilever_ratio(2) == relative(1.0, 0.10));
}

TEST_CASE("a door on two supports bends under a load across its middle as a plate of its thickness does") {
  CHECK(pressed_ratio() == relative(1.0, 0.10));
}

TEST_CASE("a door stretches as a strip of its thickness does") {
  CHECK(pull_ratio(0) == relative(1.0, 0.10));
  CHECK(pull_ratio(2) == relative(1.0, 0.10));
}

TEST_CASE("a door has the mass of its thickness") {
  const Piece door = part_at_rest(Part::door);
  const PartRecipe& recipe = part_recipe(Part::door);
  CHECK(elastic::total_mass_kg(door.body) ==
        relative(material_data(recipe.material).elastic.density_kgpm3 * 1.1 * 0.9 * recipe.sheet_m, 1e-9));
}

TEST_CASE("a door bent round a drum springs back by the curvature at which its section flows") {
  for (const int axis : {0, 2}) {
    CAPTURE(axis);
    Sheet sheet = sheet_along(axis);
    const double flowing_1pm = flowing_curvature_1pm(sheet);
    bend_round_drum(sheet, 0.97 * flowing_1pm);
    CHECK(flow(sheet.piece).elements == 0);
    bend_round_drum(sheet, 2.5 * flowing_1pm);
    const double before_j = elastic::elastic_energy_j(sheet.piece.body);
    const Flow flowed = flow(sheet.piece);
    CHECK(flowed.plastic_j == relative(before_j - elastic::elastic_energy_j(sheet.piece.body), 1e-9));
    settle(sheet.piece);
    CHECK(curvature_1pm(sheet) == relative(1.5 * flowing_1pm, 0.05));
  }
}

TEST_CASE("a door that bends fast is as thick after a step as before it") {
  Sheet sheet;
  auto& body = sheet.piece.body;
  constexpr double bending_1pms = 20.0, step_s = 1.0 / 240.0;  // Its ends turn by 2.6 degrees.
  for (std::size_t i = 0; i < body.position_m.size(); ++i) {
    const Eigen::Vector3d& rest_m = body.rest_position_m[i];
    body.velocity_mps[i] = bending_1pms * rest_m.x() * Eigen::Vector3d(-rest_m.y(), 0.5 * rest_m.x(), 0.0);
  }
  elastic::StepSettings settings;
  settings.step_s = step_s;
  settings.solver = elastic::Solver::direct;
  elastic::step_elastic(body, settings);
  double most = 0.0, turned = 0.0;
  for (const auto& cell : body.shell.cells)
    for (std::size_t k = 0; k < 4; ++k) {
      const auto low = static_cast<std::size_t>(cell.nodes[k]), high = static_cast<std::size_t>(cell.nodes[k + 4]);
      const Eigen::Vector3d out = (body.position_m[high] - body.position_m[low]) / body.shell.height_m;
      most = std::max(most, std::abs(out.norm() - 1.0));
      turned = std::max(turned, std::abs(out.normalized().x()));
    }
  CHECK(turned > 0.02);
  CHECK(most < 1e-4);
}

TEST_CASE("a door that spins freely keeps its energy and its length") {
  for (const int axis : {0, 1, 2}) {
    CAPTURE(axis);
    Sheet sheet;
    auto& body = sheet.piece.body;
    Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < body.position_m.size(); ++i) centre_m += body.mass_kg[i] * body.position_m[i];
    centre_m /= elastic::total_mass_kg(body);
    for (std::size_t i = 0; i < body.position_m.size(); ++i)
      body.velocity_mps[i] = 10.0 * Eigen::Vector3d::Unit(axis).cross(body.position_m[i] - centre_m);
    const auto length_m = [&] {
      return (way_m(sheet, 1.0, {body.position_m.size(), Eigen::Vector3d::Zero()}) -
              way_m(sheet, 0.0, {body.position_m.size(), Eigen::Vector3d::Zero()}))
          .norm();
    };
    const auto energy_j = [&] { return elastic::kinetic_energy_j(body) + elastic::elastic_energy_j(body); };
    const double before_j = energy_j(), before_m = length_m();
    elastic::StepSettings settings;
    settings.step_s = 1.0 / 240.0;
    settings.gravity_mps2.setZero();
    settings.solver = elastic::Solver::direct;
    for (int k = 0; k < 240; ++k) elastic::step_elastic(body, settings);
    CHECK(energy_j() == relative(before_j, 0.005));
    CHECK(length_m() == relative(before_m, 0.005));
  }
}

TEST_CASE("a door stretched beyond its yield stays longer") {
  Sheet sheet;
  for (auto& x : sheet.piece.body.position_m) x.x() *= 1.02;  // Steel yields at a twentieth of it.
  CHECK(flow(sheet.piece).elements == static_cast<int>(sheet.piece.body.elements.size()));
  const auto& body = sheet.piece.body;
  for (const auto& cell : body.shell.natural)
    for (const auto& strain : cell) CHECK(strain[0] > 0.018);
}

TEST_CASE("a piece of a broken door keeps its bend") {
  Sheet sheet;
  bend_round_drum(sheet, 2.5 * flowing_curvature_1pm(sheet));
  flow(sheet.piece);
  const double whole_j = elastic::elastic_energy_j(sheet.piece.body);
  sheet.piece.body.step_stress_pa.assign(sheet.piece.body.elements.size(),
                                         2.0 * sheet.piece.material.strength_pa * Eigen::Matrix3d::Identity());
  const FractureResult broken = fracture(sheet.piece);
  REQUIRE(broken.pieces.size() > 1);
  double sum_j = 0.0;
  for (const Piece& piece : broken.pieces) sum_j += elastic::elastic_energy_j(piece.body);
  CHECK(sum_j == relative(whole_j, 1e-9));
}

TEST_CASE("a bent door goes on from its saved state as without it") {
  Sheet sheet;
  bend_round_drum(sheet, 2.5 * flowing_curvature_1pm(sheet));
  flow(sheet.piece);
  State state;
  sheet.piece.id = state.next_id++;
  state.pieces.push_back(sheet.piece);
  Bytes bytes;
  StateWriter writer(bytes);
  save_debris(state, writer);
  State again;
  StateReader reader(bytes);
  restore_debris(reader, again);
  REQUIRE(reader.ok());
  CHECK(again.pieces.front().body.shell.natural == state.pieces.front().body.shell.natural);
  ContactWorld world = level_road();
  for (int k = 0; k < 10; ++k)
    for (State* each : {&state, &again}) advance_debris(*each, world, 1.0 / 60.0);
  CHECK(again.pieces.front().body.position_m == state.pieces.front().body.position_m);
}
