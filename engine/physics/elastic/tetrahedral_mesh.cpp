#include "engine/physics/elastic/tetrahedral_mesh.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "engine/core/check.hpp"

namespace septet::elastic {

TetrahedralMesh lattice_mesh(const Eigen::Vector3i& cells, const Eigen::Vector3d& size_m) {
  SEPTET_CHECK(cells.minCoeff() > 0 && size_m.minCoeff() > 0, "cells {} {} {}", cells.x(), cells.y(), cells.z());
  TetrahedralMesh mesh;
  const auto node = [&](int i, int j, int k) { return (k * (cells.y() + 1) + j) * (cells.x() + 1) + i; };
  for (int k = 0; k <= cells.z(); ++k)
    for (int j = 0; j <= cells.y(); ++j)
      for (int i = 0; i <= cells.x(); ++i)
        mesh.nodes_m.push_back(Eigen::Array3d(i, j, k) * size_m.array() / cells.cast<double>().array());
  for (int k = 0; k < cells.z(); ++k)
    for (int j = 0; j < cells.y(); ++j)
      for (int i = 0; i < cells.x(); ++i) {
        // Corner c of the cube; mirrored in x in every other cube.
        const bool mirrored = (i + j + k) % 2 == 1;
        const auto corner = [&](int c) {
          const int x = (c & 1) ^ (mirrored ? 1 : 0);
          return node(i + x, j + ((c >> 1) & 1), k + ((c >> 2) & 1));
        };
        for (const auto& t : {Tetrahedron{0, 1, 2, 4}, Tetrahedron{3, 1, 2, 7}, Tetrahedron{5, 1, 4, 7},
                              Tetrahedron{6, 2, 4, 7}, Tetrahedron{1, 2, 4, 7}})
          mesh.tetrahedra.push_back({corner(t[0]), corner(t[1]), corner(t[2]), corner(t[3])});
      }
  return mesh;
}

double signed_volume_m3(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                        const Eigen::Vector3d& d) {
  return (b - a).cross(c - a).dot(d - a) / 6.0;
}

bool is_flat(const std::vector<Eigen::Vector3d>& x, const Tetrahedron& tetrahedron) {
  const auto [a, b, c, d] = tetrahedron;
  const double longest = std::max({(x[b] - x[a]).norm(), (x[c] - x[a]).norm(), (x[d] - x[a]).norm(),
                                   (x[c] - x[b]).norm(), (x[d] - x[b]).norm(), (x[d] - x[c]).norm()});
  return !(std::abs(signed_volume_m3(x[a], x[b], x[c], x[d])) > 1e-7 * longest * longest * longest);
}

Expected<void> validate(const TetrahedralMesh& mesh) {
  const auto node_count = static_cast<int>(mesh.nodes_m.size());
  if (node_count == 0 || mesh.tetrahedra.empty())
    return failure("the mesh is empty", "tetrahedral mesh", "give nodes and tetrahedra");
  std::vector<bool> used(mesh.nodes_m.size(), false);
  for (int i = 0; i < node_count; ++i)
    if (!mesh.nodes_m[i].allFinite())
      return failure("a coordinate is not a finite number", fmt::format("node {}", i), "give metres");
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const auto& tetrahedron = mesh.tetrahedra[t];
    const auto where = fmt::format("tetrahedron {}", t);
    for (const int i : tetrahedron) {
      if (i < 0 || i >= node_count)
        return failure(fmt::format("node {} of {} does not exist", i, node_count), where, "count nodes from zero");
      used[i] = true;
    }
    if (is_flat(mesh.nodes_m, tetrahedron))
      return failure("the tetrahedron is flat", where, "move its nodes apart or leave it out");
  }
  for (int i = 0; i < node_count; ++i)
    if (!used[i]) return failure("the node belongs to no tetrahedron", fmt::format("node {}", i), "leave it out");
  return {};
}

std::vector<SurfaceTriangle> surface_triangles(const std::vector<Eigen::Vector3d>& nodes_m,
                                               const std::vector<Tetrahedron>& tetrahedra) {
  std::map<std::array<int, 3>, int> count;
  const auto key = [](std::array<int, 3> face) {
    std::ranges::sort(face);
    return face;
  };
  for (const auto& t : tetrahedra)
    for (const auto& f : tetrahedron_faces) ++count[key({t[f[0]], t[f[1]], t[f[2]]})];
  std::vector<SurfaceTriangle> result;
  for (std::size_t index = 0; index < tetrahedra.size(); ++index) {
    const auto& t = tetrahedra[index];
    for (int opposite = 0; opposite < 4; ++opposite) {
      const auto& f = tetrahedron_faces[opposite];
      std::array<int, 3> face{t[f[0]], t[f[1]], t[f[2]]};
      if (count[key(face)] != 1) continue;
      if (signed_volume_m3(nodes_m[face[0]], nodes_m[face[1]], nodes_m[face[2]], nodes_m[t[opposite]]) > 0)
        std::swap(face[1], face[2]);
      result.push_back({face, static_cast<int>(index)});
    }
  }
  return result;
}

}  // namespace septet::elastic
