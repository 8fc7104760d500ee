#pragma once
/// The Cornell box, and parts of scenes for the ray tracer: an even sky, a view, triangles. For tests, benchmarks and
/// peers.

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>

#include "engine/raytrace/ray_tracer.hpp"

namespace septet::raytrace {

/// Sky of the same radiance in all directions, without a sun.
inline std::shared_ptr<const instant::SkyLight> even_sky(float radiance) {
  instant::SkyLight light;
  light.table.radiance.assign(std::size_t{instant::SkyTable::columns} * instant::SkyTable::rows, glm::vec3(radiance));
  return std::make_shared<const instant::SkyLight>(light);
}

/// View from a place along +x of the world, up is z.
inline instant::Instant instant_from(const Vec3& eye_m, double angle_rad, std::uint32_t side_px,
                                     std::shared_ptr<const instant::SkyLight> light) {
  instant::Instant instant;
  instant.light = std::move(light);
  instant.environment.cloud_cover = 0.0;  // The sky is that of its table.
  instant::FrameView view;
  view.projection = instant::symmetric_view(eye_m, 0.0, 0.0, angle_rad, angle_rad);
  view.viewport = {0, 0, side_px, side_px};
  instant.views.push_back(view);
  return instant;
}

inline void add_triangle(scene::SurfaceMesh& mesh, const std::array<glm::vec3, 3>& corners) {
  const glm::vec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
  for (const glm::vec3& corner : corners) {
    mesh.indices.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
    mesh.vertices.push_back({corner, normal, {}});
  }
}

/// The Cornell box as Mitsuba 3 ships it (`mi.cornell_box()`): 36 triangles, x to the right, y up, the camera at z =
/// 3.9. Here z is up and the camera looks along x.
inline scene::ResolvedScene cornell_box() {
  scene::ResolvedScene scene;
  const auto add_material = [&](const glm::vec3& color, const glm::vec3& emission = glm::vec3(0.0f)) {
    scene::SurfaceMaterial material;
    material.base_color = color;
    material.roughness = 1.0f;
    material.emission = emission;
    material.two_sided = emission == glm::vec3(0.0f);  // Same as all rectangles there; some face away.
    scene.materials.push_back(material);
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
  };
  const glm::vec3 white_color(0.885809f, 0.698859f, 0.666422f);
  const std::uint32_t white = add_material(white_color), green = add_material({0.105421f, 0.37798f, 0.076425f}),
                      red = add_material({0.570068f, 0.0430135f, 0.0443706f}),
                      light = add_material(white_color, {18.387f, 13.9873f, 6.75357f});
  scene::SurfaceMesh mesh;
  const auto septet = [](const glm::vec4& p) { return glm::vec3(-p.z, -p.x, p.y); };
  const auto add_rectangle = [&](const glm::mat4& place, std::uint32_t material) {
    const auto first = static_cast<std::uint32_t>(mesh.indices.size());
    const glm::vec3 c[4] = {septet(place * glm::vec4(-1, -1, 0, 1)), septet(place * glm::vec4(1, -1, 0, 1)),
                            septet(place * glm::vec4(1, 1, 0, 1)), septet(place * glm::vec4(-1, 1, 0, 1))};
    add_triangle(mesh, {c[0], c[1], c[2]});
    add_triangle(mesh, {c[0], c[2], c[3]});
    mesh.parts.push_back({first, 6, material});
  };
  const glm::mat4 one(1.0f);
  const auto turn = [](const glm::mat4& m, float degrees, const glm::vec3& axis) {
    return glm::rotate(m, glm::radians(degrees), axis);
  };
  const glm::vec3 x(1, 0, 0), y(0, 1, 0);
  add_rectangle(glm::scale(turn(glm::translate(one, {0.0f, 0.99f, 0.01f}), 90, x), {0.23f, 0.19f, 0.19f}), light);
  add_rectangle(turn(glm::translate(one, {0, -1, 0}), -90, x), white);
  add_rectangle(turn(glm::translate(one, {0, 1, 0}), 90, x), white);
  add_rectangle(glm::translate(one, {0, 0, -1}), white);
  add_rectangle(turn(glm::translate(one, {1, 0, 0}), -90, y), green);
  add_rectangle(turn(glm::translate(one, {-1, 0, 0}), 90, y), red);
  const auto add_cube = [&](const glm::mat4& place) {
    for (int side = 0; side < 4; ++side)
      add_rectangle(glm::translate(turn(place, 90.0f * static_cast<float>(side), y), {0, 0, 1}), white);
    for (const float angle : {90.0f, -90.0f}) add_rectangle(glm::translate(turn(place, angle, x), {0, 0, 1}), white);
  };
  add_cube(glm::scale(turn(glm::translate(one, {0.335f, -0.7f, 0.38f}), -17, y), glm::vec3(0.3f)));
  add_cube(glm::scale(turn(glm::translate(one, {-0.33f, -0.4f, -0.28f}), 18.25f, y), {0.3f, 0.61f, 0.3f}));
  mesh.bounds_min_m = glm::vec3(-1.0f), mesh.bounds_max_m = glm::vec3(1.0f);
  scene.meshes.push_back(std::move(mesh));
  scene.instances.push_back({});
  return scene;
}

inline instant::Instant before_cornell_box(std::uint32_t side_px) {
  return instant_from({-3.9, 0.0, 0.0}, 39.3077 * std::numbers::pi / 180.0, side_px, even_sky(0.0f));
}

/// Settings of the peers' figures: six edges, a box filter, no early ends.
inline TraceSettings cornell_settings(std::uint32_t samples, std::uint64_t seed = 0) {
  return {.samples = samples, .paths = {.longest = 6, .roulette_from = 100}, .filter = Filter::box, .seed = seed};
}

}  // namespace septet::raytrace
