#pragma once
/// A world about as large as a motorway's, for measurements.

#include <cmath>

#include "engine/core/random.hpp"
#include "engine/scene/builder.hpp"

namespace septet::replication {

/// A strip of `length` × `width` quads that winds and rolls, with texture coordinates.
inline geometry::PolygonMesh strip(std::uint32_t length, std::uint32_t width, double phase) {
  geometry::PolygonMesh mesh;
  for (std::uint32_t i = 0; i <= length; ++i)
    for (std::uint32_t k = 0; k <= width; ++k) {
      const double s = 4.0 * i;
      mesh.vertices_m.push_back(
          {s, 2.0 * k + 30.0 * std::sin(s / 300.0 + phase), 3.0 * std::sin(s / 90.0 + 0.4 * k + phase)});
    }
  for (std::uint32_t i = 0; i < length; ++i)
    for (std::uint32_t k = 0; k < width; ++k) {
      const std::uint32_t v = i * (width + 1) + k;
      mesh.polygons.push_back({v, v + width + 1, v + width + 2, v + 1});
      const float u = 0.25f * i, t = 0.5f * k;
      mesh.corner_uvs.push_back({glm::vec2(u, t), {u + 0.25f, t}, {u + 0.25f, t + 0.5f}, {u, t + 0.5f}});
    }
  return mesh;
}

/// Builds about 420,000 vertices in 40 meshes, 6 images of 512², 4,000 placed objects.
inline void build_sample_world(scene::SceneBuilder& build) {
  Random random(1);
  std::vector<scene::NodeId> materials, meshes;
  for (int i = 0; i < 6; ++i) {
    std::vector<std::uint8_t> rgba;
    for (int y = 0; y < 512; ++y)
      for (int x = 0; x < 512; ++x) {
        const double base = 128.0 + 60.0 * std::sin(x / 20.0) * std::sin(y / 31.0);
        for (int c = 0; c < 3; ++c) rgba.push_back(static_cast<std::uint8_t>(base + 3.0 * c + 12.0 * random.uniform()));
        rgba.push_back(255);
      }
    materials.push_back(build.add_material("", {.base_color_bitmap = build.add_bitmap("", 512, 512, rgba)}));
  }
  for (int i = 0; i < 40; ++i) meshes.push_back(build.add_mesh("", strip(500, 20, i)));
  for (int i = 0; i < 4000; ++i) {
    const std::size_t which = random.below(meshes.size());
    build.add_object("", {.parent_from_object = {{random.uniform(-5000, 5000), random.uniform(-5000, 5000), 0},
                                                 orientation_from_angles(random.uniform(0, 6), 0, 0)},
                          .geometry = meshes[which],
                          .materials = {materials[which % materials.size()]},
                          .visible_to_m = 800.0f});
  }
}

}  // namespace septet::replication
