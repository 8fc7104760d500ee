#pragma once
/// Cracks through brittle sheets: where the stress of a bent sheet's surfaces (sheet_stress.hpp) begins one, and how far
/// it runs.

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "engine/effects/debris/inner_face.hpp"
#include "engine/effects/debris/piece.hpp"
#include "engine/effects/debris/sheet_stress.hpp"

namespace septet::debris {

/// Share of the strength down to which a crack of a brittle sheet runs on. Chosen: by Griffith's law one as long as a
/// cube runs on at a tenth of it in ice and less in glass, but the load falls within a tick, which its stress does not
/// show.
inline constexpr double least_running_share = 0.4;

/// What a sheet's surfaces do to a face, at the worst of its nodes.
struct SheetLoad {
  double overload = 0.0;               ///< Where it is pulled across.
  double pull = 0.0;                   ///< The greatest pull, whichever way, over the strength.
  Eigen::Vector3d way{1.0, 0.0, 0.0};  ///< Of the greatest pull, in the axes of rest.
};

/// Load of a face; pulls below `least` of the strength may be left out. Faces within a cube run along its diagonals,
/// near 45° to either side, and a cut along a side has to pass them: they count as pulled across within 50°.
SheetLoad sheet_load(const SheetStress& sheet, const Piece& piece, const InnerFace& face, double least);

/// Places in `faces` of those that part as a brittle sheet's most overloaded face gives way. A crack as long as a cube
/// runs on where a face without one would hold: straight across the pull that began it, between the splinters whose
/// middles lie on its two sides, as far as the surfaces are pulled by `least_running_share` of the strength.
std::vector<std::size_t> run_through(const Piece& piece, const std::vector<InnerFace>& faces,
                                     const std::vector<SheetLoad>& loads);

}  // namespace septet::debris
