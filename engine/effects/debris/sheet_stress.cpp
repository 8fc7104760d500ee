#include "engine/effects/debris/sheet_stress.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "engine/effects/debris/breakable_part.hpp"
#include "engine/physics/elastic/element.hpp"

namespace septet::debris {

std::array<int, 2> cube_of(const SheetStress& sheet, const Piece& piece, int element) {
  std::array<int, 2> cube{};
  for (int c = 0; c < 2; ++c) {
    const auto k = static_cast<std::size_t>(c);
    double middle_m = 0.0;
    for (const int node : piece.body.elements[static_cast<std::size_t>(element)].nodes)
      middle_m += 0.25 * piece.body.rest_position_m[static_cast<std::size_t>(node)][sheet.axes[k]];
    cube[k] = std::clamp(static_cast<int>((middle_m - sheet.low_m[c]) / sheet.cube_m[c]), 0, sheet.count[k] - 1);
  }
  return cube;
}

namespace {

/// The stress of an element in the axes of its rest. Pressed flat or inside out it carries nothing that could be told.
Eigen::Matrix3d stress_at_rest_pa(const elastic::ElasticBody& body, std::size_t element) {
  const Eigen::Matrix3d f = elastic::deformation_gradient(body.elements[element], body.position_m);
  const double volume = f.determinant();
  if (!(volume > elastic::least_determinant)) return Eigen::Matrix3d::Zero();
  const Eigen::Matrix3d back = f.inverse();
  return volume * back * body.step_stress_pa[element] * back.transpose();
}

/// Without its load.
std::optional<SheetStress> sheet_of(const Piece& piece) {
  const PartRecipe& recipe = part_recipe(piece.part);
  int across = 0;
  while (across < 3 && recipe.cells[across] != 1) ++across;
  if (across == 3 || recipe.taper != 1.0 || piece.material.yield_pa > 0.0) return std::nullopt;
  SheetStress sheet;
  sheet.axes = {across == 0 ? 1 : 0, across == 2 ? 1 : 2, across};
  for (int c = 0; c < 2; ++c) {
    const int axis = sheet.axes[static_cast<std::size_t>(c)];
    sheet.count[static_cast<std::size_t>(c)] = recipe.cells[axis];
    sheet.cube_m[c] = recipe.size_m[axis] / recipe.cells[axis];
    sheet.low_m[c] = -0.5 * recipe.size_m[axis];
  }
  sheet.height_m = across == 2 ? piece.height_m : recipe.size_m[across];
  sheet.fill = piece.material.strength_pa / material_data(recipe.material).strength_pa;
  sheet.cubes.resize(static_cast<std::size_t>(sheet.count[0] * sheet.count[1]));
  return sheet;
}

std::size_t index_of(const SheetStress& sheet, const std::array<int, 2>& cube) {
  return static_cast<std::size_t>(cube[1] * sheet.count[0] + cube[0]);
}

/// Whether a node lies at the high side of its cube, along each axis within the sheet.
std::array<bool, 2> side_of(const SheetStress& sheet, const Piece& piece, const std::array<int, 2>& cube, int node) {
  std::array<bool, 2> high{};
  for (int c = 0; c < 2; ++c) {
    const auto k = static_cast<std::size_t>(c);
    const double middle_m = sheet.low_m[c] + (cube[k] + 0.5) * sheet.cube_m[c];
    high[k] = piece.body.rest_position_m[static_cast<std::size_t>(node)][sheet.axes[k]] > middle_m;
  }
  return high;
}

/// Adds the forces that hold an element's nodes against its stress. `even_pa`: of it as much as its whole cube has
/// within the sheet, which bends nothing; by their diagonals, though, the cube's tetrahedra give its corners unlike
/// shares of it.
void add_element(SheetStress& sheet, const Piece& piece, const elastic::Element& e, const std::array<int, 2>& place,
                 const Eigen::Matrix3d& stress_pa, const Eigen::Matrix3d& even_pa) {
  SheetCube& cube = sheet.cubes[index_of(sheet, place)];
  const auto gradients = elastic::shape_gradients(e);
  const auto within = [&](const Eigen::Vector3d& v) { return Eigen::Vector2d(v[sheet.axes[0]], v[sheet.axes[1]]); };
  for (std::size_t a = 0; a < 4; ++a) {
    const Eigen::Vector2d force_n = within(e.rest_volume_m3 * stress_pa * gradients[a]),
                          bending_n = force_n - within(e.rest_volume_m3 * even_pa * gradients[a]);
    const auto high = side_of(sheet, piece, place, e.nodes[a]);
    const bool front = piece.body.rest_position_m[static_cast<std::size_t>(e.nodes[a])][sheet.axes[2]] > 0.0;
    const double arm_m = front ? 0.5 * sheet.height_m : -0.5 * sheet.height_m;
    for (std::size_t c = 0; c < 2; ++c) {
      const double out_1pm = (high[c] ? 1.0 : -1.0) / sheet.cube_m[c == 0 ? 1 : 0];
      SheetSide& side = cube[2 * c + (high[c] ? 1 : 0)];
      side.force_npm += out_1pm * force_n;
      side.moment_n += out_1pm * arm_m * bending_n;
    }
  }
}

/// Mean of a cube's elements by their volume, of the stress within the sheet.
std::vector<Eigen::Matrix3d> even_stress_pa(const SheetStress& sheet, const Piece& piece,
                                            const std::vector<std::array<int, 2>>& places,
                                            const std::vector<Eigen::Matrix3d>& stress_pa) {
  std::vector<Eigen::Matrix3d> even_pa(sheet.cubes.size(), Eigen::Matrix3d::Zero());
  std::vector<double> volume_m3(sheet.cubes.size(), 0.0);
  for (std::size_t e = 0; e < stress_pa.size(); ++e) {
    const std::size_t cube = index_of(sheet, places[e]);
    volume_m3[cube] += piece.body.elements[e].rest_volume_m3;
    even_pa[cube] += piece.body.elements[e].rest_volume_m3 * stress_pa[e];
  }
  for (std::size_t k = 0; k < even_pa.size(); ++k) {
    if (volume_m3[k] > 0.0) even_pa[k] /= volume_m3[k];
    even_pa[k].row(sheet.axes[2]).setZero();
    even_pa[k].col(sheet.axes[2]).setZero();
  }
  return even_pa;
}

std::array<Eigen::Matrix3d, 2> at_corner_pa(const SheetStress& sheet, const SheetCube& cube,
                                            const std::array<bool, 2>& high) {
  const SheetSide &first = cube[high[0] ? 1 : 0], &second = cube[high[1] ? 3 : 2];
  const auto tensor = [&](Eigen::Vector2d SheetSide::*of) -> Eigen::Matrix3d {
    const double shear = 0.25 * ((cube[0].*of).y() + (cube[1].*of).y() + (cube[2].*of).x() + (cube[3].*of).x());
    Eigen::Matrix3d result = Eigen::Matrix3d::Zero();
    result(sheet.axes[0], sheet.axes[0]) = (first.*of).x();
    result(sheet.axes[1], sheet.axes[1]) = (second.*of).y();
    result(sheet.axes[0], sheet.axes[1]) = result(sheet.axes[1], sheet.axes[0]) = shear;
    return result;
  };
  const Eigen::Matrix3d stretched_pa = tensor(&SheetSide::force_npm) / sheet.height_m;
  const Eigen::Matrix3d bent_pa = 6.0 / (sheet.fill * sheet.height_m * sheet.height_m) * tensor(&SheetSide::moment_n);
  return {stretched_pa + bent_pa, stretched_pa - bent_pa};
}

}  // namespace

std::optional<SheetStress> sheet_stress(const Piece& piece) {
  if (piece.body.step_stress_pa.empty()) return std::nullopt;
  auto sheet = sheet_of(piece);
  if (!sheet) return std::nullopt;
  std::vector<std::array<int, 2>> places;
  std::vector<Eigen::Matrix3d> stress_pa;
  places.reserve(piece.body.elements.size());
  stress_pa.reserve(piece.body.elements.size());
  for (std::size_t e = 0; e < piece.body.elements.size(); ++e) {
    places.push_back(cube_of(*sheet, piece, static_cast<int>(e)));
    stress_pa.push_back(stress_at_rest_pa(piece.body, e));
  }
  const auto even_pa = even_stress_pa(*sheet, piece, places, stress_pa);
  for (std::size_t e = 0; e < stress_pa.size(); ++e)
    add_element(*sheet, piece, piece.body.elements[e], places[e], stress_pa[e], even_pa[index_of(*sheet, places[e])]);
  return sheet;
}

std::array<Eigen::Matrix3d, 2> surface_stress_pa(const SheetStress& sheet, const Piece& piece, int element, int node) {
  const auto cube = cube_of(sheet, piece, element);
  return at_corner_pa(sheet, sheet.cubes[index_of(sheet, cube)], side_of(sheet, piece, cube, node));
}

double greatest_surface_stress_pa(const SheetStress& sheet) {
  // at_corner_pa of all corners at once: their stresses along the axes vary by side alone, and the shear by cube.
  const double stretch_pm = 1.0 / sheet.height_m, bend_pm2 = 6.0 / (sheet.fill * sheet.height_m * sheet.height_m);
  double greatest_pa2 = 0.0;
  for (const SheetCube& cube : sheet.cubes)
    for (const double surface : {bend_pm2, -bend_pm2}) {
      const auto at = [&](const SheetSide& side) -> Eigen::Vector2d {
        return stretch_pm * side.force_npm + surface * side.moment_n;
      };
      const Eigen::Vector2d low = at(cube[0]), high = at(cube[1]), near = at(cube[2]), far = at(cube[3]);
      const double shear_pa = 0.25 * (low.y() + high.y() + near.x() + far.x());
      const double along_pa2 = std::max(low.x() * low.x(), high.x() * high.x()),
                   across_pa2 = std::max(near.y() * near.y(), far.y() * far.y());
      greatest_pa2 = std::max(greatest_pa2, along_pa2 + across_pa2 + 2.0 * shear_pa * shear_pa);
    }
  return std::sqrt(greatest_pa2);
}

Eigen::Vector3d normal_within(const SheetStress& sheet, const Piece& piece, const std::array<int, 3>& face) {
  const auto& rest_m = piece.body.rest_position_m;
  const auto at = [&](std::size_t k) { return rest_m[static_cast<std::size_t>(face[k])]; };
  Eigen::Vector3d normal = (at(1) - at(0)).cross(at(2) - at(0));
  normal[sheet.axes[2]] = 0.0;
  return normal.normalized();
}

}  // namespace septet::debris
