#pragma once
/// Tetrahedral meshes: the rest shape of an elastic body, in metres, and the lattice that most of
/// Septet's breakable parts are cut from.

#include <array>
#include <vector>

#include <Eigen/Core>

#include "engine/core/expected.hpp"

namespace septet::elastic {

using Tetrahedron = std::array<int, 4>;  ///< Four node indices; either orientation is accepted.

struct TetrahedralMesh {
  std::vector<Eigen::Vector3d> nodes_m;
  std::vector<Tetrahedron> tetrahedra;
};

/// A box of `cells` cubes (or bricks), each cut into five tetrahedra; neighbouring cubes are mirror
/// images so that their faces agree. The box starts at the origin.
TetrahedralMesh lattice_mesh(const Eigen::Vector3i& cells, const Eigen::Vector3d& size_m);

/// Error: a mesh without nodes or tetrahedra, an index out of range, a non-finite number, a flat tetrahedron or a node
/// that belongs to none.
Expected<void> validate(const TetrahedralMesh& mesh);

/// Signed volume: positive where the fourth node is on the side of (b−a) × (c−a).
double signed_volume_m3(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                        const Eigen::Vector3d& d);

/// True where a tetrahedron has next to no volume for its longest edge, or a number of it is not finite.
bool is_flat(const std::vector<Eigen::Vector3d>& nodes_m, const Tetrahedron& tetrahedron);

/// One triangle of the outer surface, counter-clockwise seen from outside.
struct SurfaceTriangle {
  std::array<int, 3> nodes;
  int tetrahedron;
};

/// The faces that belong to one tetrahedron only, in the order of the tetrahedra.
std::vector<SurfaceTriangle> surface_triangles(const std::vector<Eigen::Vector3d>& nodes_m,
                                               const std::vector<Tetrahedron>& tetrahedra);

/// The four faces of a tetrahedron as places in it; face f is opposite to node f.
inline constexpr std::array<std::array<int, 3>, 4> tetrahedron_faces{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

}  // namespace septet::elastic
