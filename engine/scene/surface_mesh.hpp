#pragma once
/// A geometry node as triangles (CONVENTIONS.md, "Geometry").

#include <functional>

#include "engine/geometry/polygon_mesh.hpp"
#include "engine/scene/node.hpp"
#include "engine/scene/resolved_scene.hpp"

namespace septet::scene {

/// The node's polygons with the layers that are drawn; invalid polygons are left out.
geometry::PolygonMesh polygons_of(const GeometryData& geometry);

/// Triangles with normals and bounds. `material_of` maps a polygon's material index to an index of
/// ResolvedScene::materials. Every used corner must exist. The revision is left at zero.
SurfaceMesh triangulate(const geometry::PolygonMesh& mesh,
                        const std::function<std::uint32_t(std::uint32_t)>& material_of);

/// Combines the two, with the node's subdivision.
SurfaceMesh surface_of_geometry(const Node& node, const std::function<std::uint32_t(std::uint32_t)>& material_of);

}  // namespace septet::scene
