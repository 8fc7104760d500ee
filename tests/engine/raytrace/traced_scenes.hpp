#pragma once
/// Scenes with a known solution: the Cornell box, balls under an even sky, and shared parts of the ray tracer's tests.

#include <array>
#include <map>

#include <doctest/doctest.h>

#include "tests/engine/raytrace/cornell_box.hpp"
#include "tests/engine/raytrace/whole_picture.hpp"

namespace septet::raytrace {

/// Ball of radius 1 with 20·4^splits triangles and the sphere's normals.
inline scene::SurfaceMesh ball(int splits) {
  const float g = 0.5f * (1.0f + std::sqrt(5.0f));
  std::vector<glm::vec3> points{{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  for (glm::vec3& point : points) point = glm::normalize(point);
  std::vector<std::array<std::uint32_t, 3>> faces{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                                  {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                                  {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                                  {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int split = 0; split < splits; ++split) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [found, fresh] =
          middles.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<std::uint32_t>(points.size()));
      if (fresh) points.push_back(glm::normalize(points[a] + points[b]));
      return found->second;
    };
    std::vector<std::array<std::uint32_t, 3>> finer;
    for (const auto& f : faces) {
      const std::uint32_t a = middle(f[0], f[1]), b = middle(f[1], f[2]), c = middle(f[2], f[0]);
      finer.insert(finer.end(), {{f[0], a, c}, {f[1], b, a}, {f[2], c, b}, {a, b, c}});
    }
    faces = std::move(finer);
  }
  scene::SurfaceMesh mesh;
  for (const glm::vec3& point : points) mesh.vertices.push_back({point, point, {}});
  for (const auto& face : faces) mesh.indices.insert(mesh.indices.end(), face.begin(), face.end());
  mesh.parts.push_back({0, static_cast<std::uint32_t>(mesh.indices.size()), 0});
  mesh.bounds_min_m = glm::vec3(-1.0f), mesh.bounds_max_m = glm::vec3(1.0f);
  return mesh;
}

/// That ball, once, of one material, at the origin.
inline scene::ResolvedScene ball_scene(const scene::SurfaceMaterial& material, int splits = 4) {
  scene::ResolvedScene scene;
  scene.materials.push_back(material);
  scene.meshes.push_back(ball(splits));
  scene.instances.push_back({});
  return scene;
}

/// Same scene to the eye, with a white image on lit surfaces: no surface is a plain matt colour, and each path is
/// traced by itself.
inline scene::ResolvedScene each_alone(scene::ResolvedScene scene) {
  for (scene::SurfaceMaterial& material : scene.materials)
    if (material.emission == glm::vec3(0.0f))
      material.base_color_image = static_cast<std::int32_t>(scene.images.size());
  scene.images.push_back({.width = 1, .height = 1, .rgba = {255, 255, 255, 255}});
  return scene;
}

/// Picture as large as the first view, on all cores, with the photons of the settings.
inline TracedPicture traced(const scene::ResolvedScene& scene, const instant::Instant& instant,
                            const TraceSettings& settings, std::vector<ClearBody> bodies = {}) {
  auto tracer = RayTracer::create(scene);
  REQUIRE(tracer.has_value());
  const instant::PixelRectangle size = instant.views.front().viewport;
  tracer->begin(instant, settings, std::move(bodies));
  send_photons(*tracer, 2);
  return whole_picture(*tracer, size.width, size.height);
}

struct PictureMean {
  glm::dvec3 radiance{0.0};
  double sigma = 0.0;  ///< Standard deviation of the mean's luminance.
};
inline PictureMean mean_of(const TracedPicture& picture) {
  PictureMean mean;
  for (const TracedPixel& pixel : picture.pixels)
    mean.radiance += glm::dvec3(pixel.radiance), mean.sigma += pixel.variance;
  const double pixels = static_cast<double>(picture.pixels.size());
  return {mean.radiance / pixels, std::sqrt(mean.sigma) / pixels};
}

}  // namespace septet::raytrace
