#pragma once
/// Five beams of 88 nodes and 105 tetrahedra that differ a little, as those of figures 8 and 9 of Servin et al. do. The
/// paper does not tell how its own differ: these have other places of their nodes along the beam, or another section.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <utility>

#include "tests/engine/physics/elastic/beam.hpp"

namespace septet::elastic::beam {

struct Geometry {
  std::string name;
  TetrahedralMesh mesh;
  double width_m = side_m;  ///< Of the section along x; along y it is `side_m`.

  /// Torsion constant of the section, by Saint-Venant's series.
  double torsion_constant() const {
    const double longer = std::max(width_m, side_m), shorter = std::min(width_m, side_m);
    double sum = 0.0;
    for (int n = 1; n < 40; n += 2) sum += std::tanh(n * std::numbers::pi * longer / (2.0 * shorter)) / std::pow(n, 5);
    return longer * std::pow(shorter, 3) * (1.0 / 3.0 - 64.0 / std::pow(std::numbers::pi, 5) * shorter / longer * sum);
  }
};

inline std::array<Geometry, 5> five_geometries() {
  constexpr int cells = 21;
  constexpr double cell_m = length_m / cells;
  const auto beam = [&](std::string name, double width_m, const std::function<void(Eigen::Vector3d&)>& move) {
    Geometry g{std::move(name), lattice_mesh({1, 1, cells}, {width_m, side_m, length_m}), width_m};
    for (Eigen::Vector3d& node : g.mesh.nodes_m)
      if (node.z() > 1e-9 && node.z() < length_m - 1e-9) move(node);
    return g;
  };
  std::mt19937 engine(1);
  return {beam("even", side_m, [](Eigen::Vector3d&) {}),
          beam("cells short at the ends and long in the middle", side_m,
               [&](Eigen::Vector3d& node) {
                 node.z() -= 0.04 * length_m * std::sin(2.0 * std::numbers::pi * node.z() / length_m);
               }),
          beam("short and long cells by turns", side_m,
               [&](Eigen::Vector3d& node) {
                 if (std::lround(node.z() / cell_m) % 2 == 1) node.z() += 0.3 * cell_m;
               }),
          beam("nodes shifted along the beam at random", side_m,
               [&](Eigen::Vector3d& node) {
                 node.z() += 0.3 * cell_m * (static_cast<double>(engine()) / static_cast<double>(engine.max()) - 0.5);
               }),
          beam("a tenth wider", 1.1 * side_m, [](Eigen::Vector3d&) {})};
}

}  // namespace septet::elastic::beam
