#pragma once
/// Thin sheet in a lattice of one layer: its membrane and its bending are those of a plate of the sheet's own thickness.
///
/// A cell is a brick of the lattice (eight nodes, five tetrahedra in sequence). Half the sum of a pair of nodes across
/// the sheet is a place on its middle surface, m; their difference over the lattice's height h is its director, d, a
/// unit vector across the surface at rest. Along the sheet's two axes at rest,
///     membrane   E_ab = ½ (∂a m·∂b m − δ_ab)
///     bending    K_ab = ½ (∂a m·∂b d + ∂b m·∂a d)
///     shear      γ_a  = ∂a m·d
///     thickness  ε    = ½ (d·d − 1)
/// each a quadratic form of places, as Green's strain is, so that a sheet takes part in the step in the same form
/// (step.hpp). Per area, with C the plane stress of E and ν and with t the sheet's thickness, it stores
///     t/2 E:C:E + t³/24 K:C:K + 5/12 μt γ² + E t/2 ε²,
/// so it bends with D = E t³/12(1−ν²) (Timoshenko and Woinowsky-Krieger, Theory of Plates and Shells, ch. 2), however
/// high the lattice is. Membrane and bending are taken at 2 by 2 places, shear only at the middles of the four edges, as
/// in MITC4 (Bathe and Dvorkin 1985): elsewhere a bilinear cell has shear by its bending, and locks.
///
/// The lattice's material is the sheet's spread over h: E h of it is E t of the sheet. The tetrahedra of such a body
/// carry nothing but their guard against being turned inside out.

#include <array>
#include <vector>

#include <Eigen/Core>

namespace septet::elastic {

struct ElasticBody;

/// Membrane 11, 22, 2·12, then bending 11, 22, 2·12, in 1/m.
using ShellStrain = Eigen::Matrix<double, 6, 1>;
/// At the four places of a cell.
using CellStrain = std::array<ShellStrain, 4>;

inline constexpr int tetrahedra_per_cell = 5;

struct ShellCell {
  /// Bit 0 of a corner: the high side along the sheet's first axis, bit 1: along its second, bit 2: across it.
  std::array<int, 8> nodes{};
  Eigen::Vector2d size_m{0.0, 0.0};
  std::array<int, 28> slots{};  ///< Of the blocks (1,0) (2,0) (2,1) …, the later node of the body first.
};

struct Shell {
  int across = 2;            ///< Axis at rest that is across the sheet; the others are its first and second, ascending.
  double height_m = 0.0;     ///< h, of the lattice.
  double thickness_m = 0.0;  ///< t, of the sheet; 0: the body has none, and is solid.
  double yield_npm = 0.0;    ///< Pull on a metre of width from which it flows, σt; 0: it never does.

  std::vector<CellStrain> natural;  ///< Strain at which a cell is at ease: what has flowed.
  std::vector<ShellCell> cells;     ///< Derived from the elements.

  bool empty() const { return cells.empty(); }
  /// Moment on a metre of width of a section that flows through its whole thickness, σt²/4.
  double plastic_moment_n() const { return 0.25 * yield_npm * thickness_m; }
};

/// Finds the cells of a body whose shell has a thickness; leaves none where its elements make up no bricks.
void derive_cells(ElasticBody& body);

double shell_energy_j(const ElasticBody& body);

/// Stress of an element's cell by its membrane, spread over the lattice's height; in the world's axes. Bending is not in
/// it: a section that flows through folds, and does not tear. `lead_s`: of the strain that the present velocity reaches
/// within this time, too.
Eigen::Matrix3d shell_stress_pa(const ElasticBody& body, int element, double lead_s = 0.0);

struct ShellFlow {
  double plastic_j = 0.0;       ///< Taken from what the shape had stored.
  std::vector<double> strains;  ///< Of each cell's surface, greatest of its places.
};
/// Lets it flow where force N and moment M together pass what its section carries, (N/σt)² + (4M/σt²)² = 1 by their von
/// Mises measures (Ilyushin 1948, without the mixed term): both fall back by one share.
ShellFlow flow_shell(ElasticBody& body);

}  // namespace septet::elastic
