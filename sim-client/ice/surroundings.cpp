#include "sim-client/ice/surroundings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/image/srgb.hpp"
#include "engine/instant/instant.hpp"
#include "engine/light/lamplight.hpp"

namespace septet::ice_viewer {
namespace {

constexpr float room_half_m = 400.0f;
constexpr std::uint32_t wall_px = 512;

/// Wall of the room as seen from its middle: forward, to the right, up.
struct Wall {
  glm::vec3 forward, right, up;
};
constexpr std::array<Wall, 6> walls{{{{1, 0, 0}, {0, -1, 0}, {0, 0, 1}},
                                     {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                     {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
                                     {{0, -1, 0}, {-1, 0, 0}, {0, 0, 1}},
                                     {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},
                                     {{0, 0, -1}, {1, 0, 0}, {0, 1, 0}}}};

std::uint8_t srgb_code(float linear) {
  return static_cast<std::uint8_t>(std::lround(255.0f * image::srgb_of_light(std::clamp(linear, 0.0f, 1.0f))));
}

scene::TextureImage wall_picture(const Wall& wall) {
  scene::TextureImage picture;
  picture.revision = 1;
  picture.width = picture.height = wall_px;
  for (std::uint32_t y = 0; y < wall_px; ++y)
    for (std::uint32_t x = 0; x < wall_px; ++x) {
      // Four rays a texel, for edges.
      glm::vec3 sum(0.0f);
      for (const float dx : {0.25f, 0.75f})
        for (const float dy : {0.25f, 0.75f}) {
          const float s = 2.0f * (static_cast<float>(x) + dx) / wall_px - 1.0f,
                      t = 1.0f - 2.0f * (static_cast<float>(y) + dy) / wall_px;
          sum += 0.25f * panorama(glm::normalize(wall.forward + s * wall.right + t * wall.up));
        }
      for (int c = 0; c < 3; ++c) picture.rgba.push_back(srgb_code(sum[c]));
      picture.rgba.push_back(255);
    }
  return picture;
}

void add_quad(scene::SurfaceMesh& mesh, const std::array<glm::vec3, 4>& corners, const glm::vec3& normal) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  constexpr std::array<glm::vec2, 4> uvs{{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};
  for (std::size_t i = 0; i < 4; ++i) mesh.vertices.push_back({corners[i], normal, uvs[i]});
  for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + corner);
}

/// Adds a mesh with one material a part; each part has the same number of indices.
void add_mesh(scene::ResolvedScene& scene, scene::SurfaceMesh mesh, std::vector<scene::SurfaceMaterial> materials) {
  mesh.revision = 1;
  const auto count = static_cast<std::uint32_t>(mesh.indices.size() / materials.size());
  for (std::uint32_t i = 0; i < materials.size(); ++i) {
    mesh.parts.push_back({i * count, count, static_cast<std::uint32_t>(scene.materials.size())});
    materials[i].revision = 1;
    scene.materials.push_back(materials[i]);
  }
  mesh.bounds_min_m = mesh.bounds_max_m = mesh.vertices.front().position_m;
  for (const scene::SurfaceVertex& vertex : mesh.vertices) {
    mesh.bounds_min_m = glm::min(mesh.bounds_min_m, vertex.position_m);
    mesh.bounds_max_m = glm::max(mesh.bounds_max_m, vertex.position_m);
  }
  scene::Instance instance;
  instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
  scene.instances.push_back(instance);
  scene.meshes.push_back(std::move(mesh));
}

void add_room(scene::ResolvedScene& scene) {
  // One mesh, so that the bodies in it stand under a roof.
  scene::SurfaceMesh mesh;
  std::vector<scene::SurfaceMaterial> materials;
  for (const Wall& wall : walls) {
    const auto corner = [&](float s, float t) { return room_half_m * (wall.forward + s * wall.right + t * wall.up); };
    add_quad(mesh, {corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)}, -wall.forward);
    scene::SurfaceMaterial material;
    material.base_color = glm::vec3(1.0f);
    material.base_color_image = static_cast<std::int32_t>(scene.images.size());
    material.maps[scene::SurfaceMap::emission] = material.base_color_image;
    material.roughness = 1.0f;
    // Under a roof: the light of its lamps is subtracted, so that the walls have one brightness.
    material.share_of_sky = 0.0f;
    material.emission = glm::vec3(room_radiance) - light::irradiance_between_pools / light::pi;
    scene.images.push_back(wall_picture(wall));
    materials.push_back(material);
  }
  add_mesh(scene, std::move(mesh), std::move(materials));
}

void add_field(scene::ResolvedScene& scene) {
  for (const bool light : {false, true}) {
    scene::SurfaceMesh floor;
    for (int y = -40; y < 40; ++y)
      for (int x = -40; x < 40; ++x)
        if (((x + y) & 1) == light) {
          const glm::vec3 at(x, y, -0.9f);
          add_quad(floor, {at, at + glm::vec3(1, 0, 0), at + glm::vec3(1, 1, 0), at + glm::vec3(0, 1, 0)}, {0, 0, 1});
        }
    scene::SurfaceMaterial stone;
    stone.base_color = light ? glm::vec3(0.42f, 0.40f, 0.36f) : glm::vec3(0.10f, 0.14f, 0.08f);
    stone.roughness = 0.9f;
    add_mesh(scene, std::move(floor), {stone});
  }
  constexpr int columns = 10;
  for (int i = 0; i < columns; ++i) {
    const float angle = 2.0f * std::numbers::pi_v<float> * static_cast<float>(i) / columns;
    const glm::vec3 middle(5.0f * std::cos(angle), 5.0f * std::sin(angle), 0.0f);
    scene::SurfaceMesh column;
    for (int side = 0; side < 4; ++side) {
      const float turn = 0.5f * std::numbers::pi_v<float> * static_cast<float>(side);
      const glm::vec3 out(std::cos(turn), std::sin(turn), 0), along(-out.y, out.x, 0);
      const auto corner = [&](float s, float z) { return middle + 0.3f * out + 0.3f * s * along + glm::vec3(0, 0, z); };
      add_quad(column, {corner(-1, -0.9f), corner(1, -0.9f), corner(1, 2.6f), corner(-1, 2.6f)}, out);
    }
    scene::SurfaceMaterial paint;
    constexpr std::array<glm::vec3, 4> paints{
        {{0.7f, 0.1f, 0.05f}, {0.1f, 0.25f, 0.65f}, {0.8f, 0.6f, 0.1f}, {0.1f, 0.45f, 0.2f}}};
    paint.base_color = paints[static_cast<std::size_t>(i) % paints.size()];
    add_mesh(scene, std::move(column), {paint});
  }
}

}  // namespace

glm::vec3 panorama(const glm::vec3& direction) {
  const float z = direction.z, around = std::atan2(direction.y, direction.x) / (2.0f * std::numbers::pi_v<float>);
  const glm::vec3 horizon(0.62f, 0.68f, 0.74f);
  if (z < 0.0f) {
    const glm::vec2 at(direction.x / -z, direction.y / -z);
    const bool light = (static_cast<int>(std::floor(at.x * 0.8f)) + static_cast<int>(std::floor(at.y * 0.8f))) % 2 == 0;
    const float far = std::clamp(std::hypot(at.x, at.y) / 9.0f, 0.0f, 1.0f);
    return glm::mix(light ? glm::vec3(0.55f, 0.50f, 0.42f) : glm::vec3(0.12f, 0.13f, 0.14f), 0.55f * horizon,
                    far * far);
  }
  const float sector = (around + 0.5f) * 10.0f, within = sector - std::floor(sector);
  constexpr std::array<glm::vec3, 5> paints{{{0.65f, 0.10f, 0.06f},
                                             {0.08f, 0.22f, 0.60f},
                                             {0.75f, 0.55f, 0.08f},
                                             {0.08f, 0.40f, 0.18f},
                                             {0.45f, 0.12f, 0.45f}}};
  if (z < 0.45f && within > 0.3f && within < 0.7f)
    return paints[static_cast<std::size_t>(sector) % paints.size()] * (0.6f + 0.8f * z);
  if (z > 0.55f && z < 0.75f && (within < 0.25f || within > 0.75f)) return glm::vec3(1.0f, 0.96f, 0.88f);
  return glm::mix(horizon, glm::vec3(0.10f, 0.20f, 0.42f), std::sqrt(z));
}

scene::ResolvedScene scene_around(Surroundings surroundings) {
  scene::ResolvedScene scene;
  scene.revision = 1;
  if (surroundings == Surroundings::room)
    add_room(scene);
  else
    add_field(scene);
  return scene;
}

}  // namespace septet::ice_viewer
