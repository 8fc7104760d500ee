#pragma once
/// Scene of one mesh of one material in one place.

#include <cstdint>
#include <utility>

#include "engine/scene/resolved_scene.hpp"

namespace septet::instant {

/// Bounds, revisions and the one part are filled in.
inline scene::ResolvedScene lone_mesh(scene::SurfaceMaterial material, scene::SurfaceMesh mesh,
                                      const RigidTransform& world_from_object) {
  material.revision = mesh.revision = 1;
  mesh.parts = {{0, static_cast<std::uint32_t>(mesh.indices.size()), 0}};
  mesh.bounds_min_m = mesh.bounds_max_m = mesh.vertices.front().position_m;
  for (const scene::SurfaceVertex& vertex : mesh.vertices) {
    mesh.bounds_min_m = glm::min(mesh.bounds_min_m, vertex.position_m);
    mesh.bounds_max_m = glm::max(mesh.bounds_max_m, vertex.position_m);
  }
  scene::ResolvedScene scene;
  scene.revision = 1;
  scene.materials = {std::move(material)};
  scene.meshes = {std::move(mesh)};
  scene::Instance instance;
  instance.world_from_object = world_from_object;
  scene.instances = {instance};
  return scene;
}

}  // namespace septet::instant
