#pragma once
/// The strains of one cell of a shell, their derivatives and their stiffness: what shell.hpp derives, place by place.

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "engine/physics/elastic/block_matrix.hpp"
#include "engine/physics/elastic/elastic_body.hpp"
#include "engine/physics/elastic/elastic_material.hpp"
#include "engine/physics/elastic/shell.hpp"

namespace septet::elastic {

/// Shares of the eight nodes in ∂₁m, ∂₂m, ∂₁d, ∂₂d and d, and these vectors themselves.
using ShellRows = Eigen::Matrix<double, 5, 8>;
using ShellVectors = Eigen::Matrix<double, 3, 5>;
using CellPlaces = Eigen::Matrix<double, 3, 8>;

inline CellPlaces places_of(const ShellCell& cell, const std::vector<Eigen::Vector3d>& of_nodes) {
  CellPlaces places;
  for (int k = 0; k < 8; ++k)
    places.col(k) = of_nodes[static_cast<std::size_t>(cell.nodes[static_cast<std::size_t>(k)])];
  return places;
}

/// At a place of the cell, −1 to 1 along either axis.
inline ShellRows rows_at(const Shell& shell, const ShellCell& cell, double first, double second) {
  ShellRows rows;
  for (int k = 0; k < 8; ++k) {
    const double a = (k & 1) != 0 ? 1.0 : -1.0, b = (k & 2) != 0 ? 1.0 : -1.0;
    const double value = 0.25 * (1.0 + a * first) * (1.0 + b * second);
    const double along_first = 0.5 * a * (1.0 + b * second) / cell.size_m[0],
                 along_second = 0.5 * b * (1.0 + a * first) / cell.size_m[1];
    const double out_1pm = ((k & 4) != 0 ? 1.0 : -1.0) / shell.height_m;
    rows.col(k) << 0.5 * along_first, 0.5 * along_second, out_1pm * along_first, out_1pm * along_second,
        out_1pm * value;
  }
  return rows;
}

/// `count` strains at one place, their derivatives by the places of the nodes, and their stiffness times the area that
/// the place stands for.
template <int count>
struct ShellSample {
  Eigen::Matrix<double, count, 1> strain;  ///< Beyond the natural one.
  Eigen::Matrix<double, 24, count> jacobian;
  Eigen::Matrix<double, count, count> stiffness_j;
  ShellRows rows;
  std::array<std::array<int, 2>, count> first_pair, second_pair;  ///< Rows of the products in each strain; −1: none.

  Eigen::Matrix<double, count, 1> stress_j() const { return stiffness_j * strain; }
};

namespace shell {

/// Strain k is the sum of its products of two rows' vectors; a square counts half.
template <int count>
void differentiate(const ShellVectors& u, ShellSample<count>& sample) {
  sample.jacobian.setZero();
  for (std::size_t k = 0; k < count; ++k)
    for (const auto& pair : {sample.first_pair[k], sample.second_pair[k]}) {
      const auto [p, q] = pair;
      if (p < 0) continue;
      const auto c = static_cast<Eigen::Index>(k);
      sample.strain[c] += p == q ? 0.5 * (u.col(p).squaredNorm() - 1.0) : u.col(p).dot(u.col(q));
      for (int i = 0; i < 8; ++i) {
        auto part = sample.jacobian.template block<3, 1>(3 * i, c);
        part += sample.rows(p, i) * u.col(q);
        if (p != q) part += sample.rows(q, i) * u.col(p);
      }
    }
}

}  // namespace shell

/// Plane stress over strain, times the lattice's height: of the spread material as of the sheet.
inline Eigen::Matrix3d membrane_stiffness_npm(const Shell& shell, const ElasticMaterial& spread) {
  const double nu = spread.poisson_ratio;
  Eigen::Matrix3d c;
  c << 1.0, nu, 0.0, nu, 1.0, 0.0, 0.0, 0.0, 0.5 * (1.0 - nu);
  return spread.young_modulus_pa * shell.height_m / (1.0 - nu * nu) * c;
}

/// Forces and moments on a metre of width over the strains of `ShellStrain`.
inline Eigen::Matrix<double, 6, 6> section_stiffness(const Shell& shell, const ElasticMaterial& spread) {
  Eigen::Matrix<double, 6, 6> d = Eigen::Matrix<double, 6, 6>::Zero();
  const Eigen::Matrix3d membrane = membrane_stiffness_npm(shell, spread);
  d.topLeftCorner<3, 3>() = membrane;
  d.bottomRightCorner<3, 3>() = shell.thickness_m * shell.thickness_m / 12.0 * membrane;
  return d;
}

inline std::array<Eigen::Vector2d, 4> gauss_places() {
  const double g = 0.57735026918962576;  // 1/√3.
  return {Eigen::Vector2d{-g, -g}, Eigen::Vector2d{g, -g}, Eigen::Vector2d{-g, g}, Eigen::Vector2d{g, g}};
}

/// Membrane and bending at one of the four places.
inline ShellSample<6> bending_sample(const Shell& shell, const ShellCell& cell, const ElasticMaterial& spread,
                                     const CellPlaces& x, const Eigen::Vector2d& place, const ShellStrain& natural) {
  ShellSample<6> sample;
  sample.rows = rows_at(shell, cell, place[0], place[1]);
  sample.first_pair = {{{0, 0}, {1, 1}, {0, 1}, {0, 2}, {1, 3}, {0, 3}}};
  sample.second_pair = {{{-1, -1}, {-1, -1}, {-1, -1}, {-1, -1}, {-1, -1}, {1, 2}}};
  sample.strain = -natural;
  sample.stiffness_j = 0.25 * cell.size_m.prod() * section_stiffness(shell, spread);
  shell::differentiate(x * sample.rows.transpose(), sample);
  return sample;
}

/// Calls `visit` with every sample of a cell: four of membrane and bending, four of shear, four of thickness.
template <class Visit>
void for_each_sample(const Shell& shell, const ShellCell& cell, const CellStrain& natural,
                     const ElasticMaterial& spread, const CellPlaces& x, const Visit& visit) {
  const auto places = gauss_places();
  for (std::size_t k = 0; k < places.size(); ++k) visit(bending_sample(shell, cell, spread, x, places[k], natural[k]));
  const double area_m2 = cell.size_m.prod();
  const auto single = [&](double first, double second, std::array<int, 2> pair, double stiffness_j) {
    ShellSample<1> sample;
    sample.rows = rows_at(shell, cell, first, second);
    sample.first_pair = {pair};
    sample.second_pair = {{{-1, -1}}};
    sample.strain.setZero();
    sample.stiffness_j << stiffness_j;
    shell::differentiate(x * sample.rows.transpose(), sample);
    visit(sample);
  };
  const double shear_j = 0.5 * area_m2 * 5.0 / 6.0 * lame_constants(spread).mu_pa * shell.height_m;
  const double thickness_j = 0.25 * area_m2 * spread.young_modulus_pa * shell.height_m;
  for (const double side : {-1.0, 1.0}) {
    single(0.0, side, {0, 4}, shear_j);
    single(side, 0.0, {1, 4}, shear_j);
    for (const double other : {-1.0, 1.0}) single(side, other, {4, 4}, thickness_j);
  }
}

/// The same for every cell of a body, with its places at `position_m`; `visit(cell, sample)`.
template <class Visit>
void for_each_sample(const ElasticBody& body, const std::vector<Eigen::Vector3d>& position_m, const Visit& visit) {
  const Shell& shell = body.shell;
  for (std::size_t k = 0; k < shell.cells.size(); ++k) {
    const ShellCell& cell = shell.cells[k];
    for_each_sample(shell, cell, shell.natural[k], body.material, places_of(cell, position_m),
                    [&](const auto& sample) { visit(cell, sample); });
  }
}

/// Adds one 3 by 3 block for every pair of a cell's nodes: `matrix` is 24 by 24, symmetric.
inline void add_cell_blocks(const ShellCell& cell, const Eigen::Matrix<double, 24, 24>& stiffness,
                            BlockMatrix& matrix) {
  const auto add = [](Block& block, const Eigen::Matrix3d& k) {
    for (int c = 0; c < 3; ++c) block.column[static_cast<std::size_t>(c)] += padded(k.col(c));
  };
  std::size_t slot = 0;
  for (int a = 0; a < 8; ++a) {
    const int node = cell.nodes[static_cast<std::size_t>(a)];
    add(matrix.diagonal[static_cast<std::size_t>(node)], stiffness.block<3, 3>(3 * a, 3 * a));
    for (int b = 0; b < a; ++b, ++slot) {
      const bool later = node > cell.nodes[static_cast<std::size_t>(b)];
      add(matrix.lower[static_cast<std::size_t>(cell.slots[slot])],
          later ? stiffness.block<3, 3>(3 * a, 3 * b) : stiffness.block<3, 3>(3 * b, 3 * a));
    }
  }
}

}  // namespace septet::elastic
