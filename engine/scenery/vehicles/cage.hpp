#pragma once
/// Control cages: creases by share, fitting to given bounds, and the subdivided surface.

#include "engine/geometry/mesh_measures.hpp"
#include "engine/geometry/polygon_mesh.hpp"

namespace septet::scenery {

/// Crease from a share: 0 is smooth, 1 is sharp.
constexpr std::uint32_t crease_share(float share) {
  return share >= 1.0f ? geometry::crease_sharp
                       : static_cast<std::uint32_t>(static_cast<double>(share) * geometry::crease_sharp);
}

/// Polygons drawn for this cage: subdivided as engine/scene's resolver does it.
geometry::PolygonMesh shown_surface(const geometry::PolygonMesh& cage, std::uint32_t subdivision_level);

/// Stretches the cage so that its subdivided surface has these bounds: subdivision pulls corners in.
void fit_bounds(geometry::PolygonMesh& cage, std::uint32_t subdivision_level, const geometry::Bounds& bounds);

}  // namespace septet::scenery
