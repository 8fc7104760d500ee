#pragma once
/// Creased subdivision surfaces: Catmull and Clark (1978) for quads, Loop (1987) for triangles, with the Verse's
/// creases.
///
/// Refinement is OpenSubdiv's; the meaning of creases is the Verse's and differs from OpenSubdiv's own:
///
/// - A crease value v sharpens by w = v / 0xFFFFFFFF, from 0 (smooth) to 1 (sharp). At every level a new point of a
///   creased edge, or the next place of a creased vertex, is (1 − w) · smooth rule + w · sharp rule.
/// - The weight is the same at every level: both halves of an edge inherit its value, and a vertex keeps its own.
///   OpenSubdiv's sharpness is a number of levels that falls by one at each (DeRose, Kass and Truong 1998); within one
///   level a sharpness below one is this same blend. So each level here is one refinement of its own with sharpness w.
///   At a vertex where creased edges meet (two: a curve; three or more: a corner), w is the mean of theirs, as in
///   OpenSubdiv.
/// - Border edges are always sharp; a corner of the border is rounded along it unless its vertex is creased.
///
/// A mesh of triangles alone is refined by Loop's scheme into four triangles each. Any other mesh is refined by Catmull
/// and Clark's: a quad gives four quads, a triangle gives three, with OpenSubdiv's "smooth triangle" weights, which
/// keep mixed meshes fair. The points lie on the control mesh of the last level, not on the limit surface.

#include <cstdint>

#include "engine/core/expected.hpp"
#include "engine/geometry/polygon_mesh.hpp"

namespace septet::geometry {

/// w of a crease value: 0 is smooth, 1 sharp.
constexpr double sharp_weight(std::uint32_t crease) { return crease / 4294967295.0; }

/// Refines `levels` times. Texture coordinates are interpolated linearly within each polygon,
/// materials are inherited. Fails where a polygon names a vertex that does not exist, or where
/// OpenSubdiv cannot make a topology of the polygons.
Expected<PolygonMesh> subdivide(const PolygonMesh& cage, std::uint32_t levels);

}  // namespace septet::geometry
