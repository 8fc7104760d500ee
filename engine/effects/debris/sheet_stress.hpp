#pragma once
/// Stress at the surfaces of a brittle sheet that is bent: of a part whose lattice is one cube thick.
///
/// One layer of linear tetrahedra cannot tell how hard its surfaces are pulled: locked, it carries a moment by shears
/// that a sheet does not have, and a tenth of its surface's stress is left along it. Across a cut, however, the nodes'
/// forces are in balance with the load, whatever the elements are. So force N and moment M of each metre of a cube's
/// four sides come from the forces by which its elements hold its corners, and the surfaces of a sheet of thickness t
/// have
///     σ = N/t ± 6 M/t²,
/// as in a plate after Kirchhoff (Timoshenko and Woinowsky-Krieger, Theory of Plates and Shells, 1959, § 21). Spread
/// over a lattice of height h = t/f (breakable_part.hpp), stress and strength are f times those of the sheet:
///     f σ = N/h ± 6 M/(f h²).

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "engine/effects/debris/piece.hpp"

namespace septet::debris {

/// Of each metre of a side of a cube: force and moment along the two axes within the sheet.
struct SheetSide {
  Eigen::Vector2d force_npm{0, 0}, moment_n{0, 0};
};

/// Low and high side along the first axis within the sheet, then along the second.
using SheetCube = std::array<SheetSide, 4>;

/// A sheet under the load that its last step carried. The axes are those of the part at rest.
struct SheetStress {
  std::array<int, 3> axes{};  ///< The two within the sheet, and the one across it.
  std::array<int, 2> count{};
  Eigen::Vector2d low_m{0, 0}, cube_m{1, 1};  ///< Lowest corner, and size of a cube.
  double height_m = 0.0;                      ///< h.
  double fill = 1.0;                          ///< f.
  std::vector<SheetCube> cubes;
};

/// Empty where the piece is of no sheet, its material flows before it breaks, or its last step has left no stress.
std::optional<SheetStress> sheet_stress(const Piece& piece);

/// Place of an element's cube along the two axes within the sheet.
std::array<int, 2> cube_of(const SheetStress& sheet, const Piece& piece, int element);

/// f σ at the two surfaces, in the axes of the part at rest, at a corner of an element's cube: where `node` lies.
std::array<Eigen::Matrix3d, 2> surface_stress_pa(const SheetStress& sheet, const Piece& piece, int element, int node);

/// The greatest f σ in the sheet: its norm.
double greatest_surface_stress_pa(const SheetStress& sheet);

/// Unit normal of a face within the sheet, which the face cuts along a line, however it tilts.
Eigen::Vector3d normal_within(const SheetStress& sheet, const Piece& piece, const std::array<int, 3>& face);

}  // namespace septet::debris
