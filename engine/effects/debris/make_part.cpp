#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "engine/core/check.hpp"
#include "engine/effects/debris/piece.hpp"
#include "engine/physics/elastic/tetrahedral_mesh.hpp"

namespace septet::debris {

elastic::Shell shell_of(const PartRecipe& recipe) {
  elastic::Shell shell;
  shell.across = axis_across(recipe);
  shell.height_m = recipe.size_m[shell.across];
  shell.thickness_m = recipe.sheet_m;
  shell.yield_npm = material_data(recipe.material).yield_pa * recipe.sheet_m;
  return shell;
}

Piece make_part(Part part, const RigidTransform& world_from_part, const Vec3& velocity_mps,
                const Vec3& angular_velocity_radps, Random& random, double height_left) {
  const PartRecipe& recipe = part_recipe(part);
  elastic::TetrahedralMesh mesh =
      elastic::lattice_mesh({recipe.cells.x, recipe.cells.y, recipe.cells.z}, to_eigen(recipe.size_m));
  for (auto& x : mesh.nodes_m) {
    x -= 0.5 * to_eigen(recipe.size_m);
    const double width = 1.0 + (recipe.taper - 1.0) * (x.z() / recipe.size_m.z + 0.5);
    x.x() *= width;
    x.y() *= width;
    x.z() *= height_left;
  }
  Piece piece;
  piece.part = part;
  piece.height_m = height_left * recipe.size_m.z;
  piece.material = spread_material(recipe);
  auto made = elastic::make_elastic_body(mesh, piece.material.elastic);
  SEPTET_CHECK(made.has_value(), "part {}: {}", static_cast<int>(part), made.error().what);
  piece.body = std::move(*made);
  piece.body.shell = shell_of(recipe);
  elastic::derive_structure(piece.body);

  std::vector<Eigen::Vector3d> seeds;
  for (int i = 0; i < recipe.splinters; ++i) {
    Eigen::Vector3d seed;
    for (int c = 0; c < 3; ++c) seed[c] = recipe.size_m[c] * (random.uniform() - 0.5);
    seeds.push_back(seed);
  }
  // A part one cube thick along the car breaks into whole cubes: a crash presses it flat, it splits across, and the
  // inner faces of a flat cube lie nearly along it. So does a sheet, whose cubes bend as wholes.
  const std::size_t together = recipe.cells.x == 1 || recipe.sheet_m > 0.0 ? elastic::tetrahedra_per_cell : 1;
  std::vector<elastic::Tetrahedron> tetrahedra;
  for (std::size_t k = 0; k < piece.body.elements.size(); ++k) {
    const auto& e = piece.body.elements[k];
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (std::size_t n = k / together * together, end = n + together; n < end; ++n)
      for (const int node : piece.body.elements[n].nodes)
        centre += 0.25 / static_cast<double>(together) * piece.body.rest_position_m[node];
    int nearest = 0;
    for (int i = 1; i < recipe.splinters; ++i)
      if ((seeds[i] - centre).squaredNorm() < (seeds[nearest] - centre).squaredNorm()) nearest = i;
    piece.splinter.push_back(nearest);
    tetrahedra.push_back(e.nodes);
  }
  piece.plastic_strain.assign(tetrahedra.size(), 0.0);
  piece.surface = elastic::surface_triangles(piece.body.rest_position_m, tetrahedra);
  for (int i = 0; i < piece.body.node_count(); ++i) {
    const Vec3 arm = world_from_part.orientation * from_eigen(piece.body.rest_position_m[i]);
    piece.body.position_m[i] = to_eigen(world_from_part.position_m + arm);
    piece.body.velocity_mps[i] = to_eigen(velocity_mps + glm::cross(angular_velocity_radps, arm));
  }
  return piece;
}

}  // namespace septet::debris
