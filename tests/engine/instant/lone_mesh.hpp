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

/// Wall, 800 m wide and high, that faces −x: of squares as large as those of distant land.
inline scene::SurfaceMesh wide_wall() {
  scene::SurfaceMesh wall;
  constexpr std::uint32_t squares = 8;
  for (std::uint32_t row = 0; row <= squares; ++row)
    for (std::uint32_t column = 0; column <= squares; ++column)
      wall.vertices.push_back(
          {{0.0f, 400.0f - 100.0f * static_cast<float>(column), -400.0f + 100.0f * static_cast<float>(row)},
           {-1, 0, 0},
           {}});
  for (std::uint32_t row = 0; row < squares; ++row)
    for (std::uint32_t column = 0; column < squares; ++column) {
      const std::uint32_t low = row * (squares + 1) + column, high = low + squares + 1;
      wall.indices.insert(wall.indices.end(), {low, low + 1, high + 1, low, high + 1, high});
    }
  return wall;
}

}  // namespace septet::instant
