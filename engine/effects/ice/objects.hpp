#pragma once
/// Objects of ice for viewing: those of the paper (section 4: a sphere of 960 polygons, an irregular cube of 4800, the
/// teapot of 14,400), a concave one, and any mesh from a Wavefront OBJ file. All fit into a ball of half a metre around
/// the origin.

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/effects/ice/cracks.hpp"

namespace septet::ice {

/// Triangles with smooth normals, three vertices each, counter-clockwise from outside; rest_m is the position.
using Surface = std::vector<IceVertex>;

Surface sphere();
/// A cube with round edges and uneven faces.
Surface cube();
/// Two lobes and a waist (concave): r = 0.55 + 0.45 cos² about the x axis.
Surface peanut();
/// Martin Newell's teapot: 32 Bézier patches of 15 × 15 quads. Handle and spout pass through the wall, as in the
/// original.
Surface teapot();

/// "sphere", "cube", "peanut" or "teapot". Error: any other name.
Expected<Surface> object(std::string_view name);

/// Reads a text in the OBJ format: `v` and `f` lines; polygons are cut into fans, other lines are skipped. `where`
/// names it in errors. Error: non-finite numbers, indices out of range, no triangles, or over two million.
Expected<Surface> read_object(std::string_view text, std::string_view where);

/// Moves and scales a surface into that ball.
void fit(Surface& surface);
/// Gives each vertex the mean of the faces around its place, weighted by their areas.
void smooth(Surface& surface);

/// Faults that keep a surface from being a solid; it is drawn none the less.
struct Faults {
  std::size_t open_edges = 0;      ///< Edges that belong to one triangle alone.
  std::size_t flat_triangles = 0;  ///< Triangles without area.
  bool inverted = false;           ///< Its volume is negative: its faces look inwards.
  bool empty = false;              ///< Surface without extent.
};
Faults faults(const Surface& surface);
/// Text for people; empty without faults.
std::string told(const Faults& faults);

Box bounds(const Surface& surface);

}  // namespace septet::ice
