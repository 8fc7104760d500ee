#pragma once
/// Materials by name for polygons: a mesh is drawn with indices into a palette, and only the materials in use are
/// linked when it is added to the scene.

#include <string_view>
#include <vector>

#include "engine/geometry/polygon_mesh.hpp"
#include "engine/scene/builder.hpp"

namespace septet::scenery {

/// Material nodes in the order of the indices that meshes of this palette use.
using Palette = std::vector<scene::NodeId>;

/// Placement and visibility of a mesh; the rest of ObjectParameters comes from the mesh and the palette.
struct Placement {
  RigidTransform parent_from_object;
  glm::vec3 scale{1.0f};
  float visible_from_m = 0.0f, visible_to_m = 1e9f;
  scene::PartRole role = scene::PartRole::fixed;
  bool casts_shadow = true;
};

/// Mesh in the scene with its materials, from which instances are made.
struct Shape {
  scene::NodeId geometry = scene::no_node;
  std::vector<scene::NodeId> materials;
};

/// Adds the mesh; its material indices are renumbered so that only used materials are linked.
Shape add_shape(scene::SceneBuilder& builder, std::string_view name, const geometry::PolygonMesh& mesh,
                const Palette& palette, const scene::MeshOptions& options = {});

/// Places a shape; as a child of `parent` unless that is no_node. Without a parent it is called by its kind and its place,
/// "tree/412.5/-81.0", whatever else stands in the world: so scripts and files of edits find it again.
scene::NodeId place(scene::SceneBuilder& builder, std::string_view name, const Shape& shape, const Placement& placement,
                    scene::NodeId parent = scene::no_node);

}  // namespace septet::scenery
