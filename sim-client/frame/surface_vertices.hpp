#pragma once
/// Corners of meshes that are divided or cut.

#include <algorithm>
#include <cstdint>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/packing.hpp>

#include "engine/scene/resolved_scene.hpp"

namespace septet::frame {

/// A corner on the way from `a` to `b`, with a unit normal.
inline scene::SurfaceVertex between(const scene::SurfaceVertex& a, const scene::SurfaceVertex& b, float share = 0.5f) {
  const glm::vec3 normal = glm::mix(a.normal, b.normal, share);
  const float length = glm::length(normal);
  scene::SurfaceVertex vertex{glm::mix(a.position_m, b.position_m, share), length > 1e-6f ? normal / length : a.normal,
                              glm::mix(a.uv, b.uv, share)};
  vertex.second_uv = glm::mix(a.second_uv, b.second_uv, share);
  vertex.tangent = share < 0.5f ? a.tangent : b.tangent;
  if (a.color != scene::white_vertex || b.color != scene::white_vertex)
    vertex.color = glm::packUnorm4x8(glm::mix(glm::unpackUnorm4x8(a.color), glm::unpackUnorm4x8(b.color), share));
  return vertex;
}

/// True if every index and every run of a mesh lies within it.
inline bool makes_sense(const scene::SurfaceMesh& mesh) {
  return std::ranges::all_of(mesh.indices, [&](std::uint32_t index) { return index < mesh.vertices.size(); }) &&
         std::ranges::all_of(mesh.parts, [&](const scene::MeshPart& part) {
           return part.first_index <= mesh.indices.size() && part.index_count <= mesh.indices.size() - part.first_index;
         });
}

}  // namespace septet::frame
