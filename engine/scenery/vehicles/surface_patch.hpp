#pragma once
/// Patches on a body: windows, lamps, plates, seams and livery, cut along one axis onto its surface and lifted off it
/// by a few millimetres.

#include <array>
#include <optional>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/geometry/mesh_builder.hpp"

namespace septet::scenery {

/// Side from which the patch is seen. Coordinates on the picture: from the front and rear (y, z), from a side (x, z),
/// from above (x, y).
enum class Face { front, rear, left, right, top };

/// Corners in the order lower left, lower right, upper right, upper left as the viewer of `face` sees them; the texture
/// runs over it upright.
struct PatchOutline {
  std::array<glm::vec2, 4> corners;
};

/// Rectangle between two opposite corners, put into the viewer's order.
PatchOutline rectangle(Face face, glm::vec2 low, glm::vec2 high);

struct PatchOptions {
  float lift_m = 0.008f;     ///< Distance along the body's smooth normals.
  float corner_cut = 0.0f;   ///< Share of each side that the rounding of a corner takes, 0 to ½.
  float min_facing = 0.05f;  ///< Least cosine between the view direction and the polygons that are still covered.
};

/// Outermost point of `body` seen from `face` at `point`.
std::optional<glm::vec3> surface_point(const geometry::PolygonMesh& body, Face face, glm::vec2 point);

/// Draws the patch with the builder's current material: the body's own polygons, cut to the outline (which must be
/// convex). Where it misses the body, nothing is drawn.
void draw_patch(geometry::MeshBuilder& builder, const geometry::PolygonMesh& body, Face face,
                const PatchOutline& outline, const PatchOptions& options = {});

/// Rest of `body` where draw_patch would have drawn on it: a hole as large as the patch.
geometry::PolygonMesh cut_out(const geometry::PolygonMesh& body, Face face, const PatchOutline& outline,
                              const PatchOptions& options = {});

/// Adds the inside of such a rest: its polygons from behind, 2 cm further in, of those that reach above `low` and whose
/// middle lies between `rear` and `front`; with the builder's material.
void add_lining(geometry::MeshBuilder& builder, const geometry::PolygonMesh& open, float low, float rear, float front);

/// Outline of the left side as seen from the right.
PatchOutline mirrored(const PatchOutline& outline);

/// Draws the patch on both sides: `outline` is that of the left side.
void draw_patch_on_both_sides(geometry::MeshBuilder& builder, const geometry::PolygonMesh& body,
                              const PatchOutline& outline, const PatchOptions& options = {});

}  // namespace septet::scenery
