/// Draws a scene by Septet and writes it for another path tracer, which draws the same (mitsuba_peer.py):
///
///     septet-peer-scene noon|night|tunnel|smoke|gloss|ice FOLDER SAMPLES
///
/// FOLDER/traced.pfm is Septet's picture, linear; scene.json names meshes (PLY), images, sky, camera and exposure;
/// ice.pfm is white at ice. peer_scenes.hpp lists the scenes' content.

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "engine/image/png.hpp"
#include "engine/raytrace/smoke.hpp"
#include "tests/engine/raytrace/peers/peer_scenes.hpp"
#include "tests/engine/raytrace/whole_picture.hpp"

namespace septet::raytrace {
namespace {

void write(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file.flush()) std::fprintf(stderr, "%s cannot be written\n", path.c_str()), std::exit(1);
}

template <class Pixel>
void write_pfm(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height, const Pixel& pixel) {
  std::string bytes = fmt::format("PF\n{} {}\n-1.0\n", width, height);
  for (std::uint32_t row = height; row-- > 0;)
    for (std::uint32_t x = 0; x < width; ++x) {
      const glm::vec3 color = pixel(x, row);
      bytes.append(reinterpret_cast<const char*>(&color), sizeof(color));
    }
  write(path, bytes);
}

/// Triangles of one material.
struct Group {
  std::vector<scene::SurfaceVertex> vertices;
  glm::vec3 color{0.0f}, emission{0.0f};
  std::int32_t image = -1;
  Gloss gloss;
  const ice::Look* ice = nullptr;  ///< Look of a body of ice, if it is one.
};

std::string ply(const Group& group) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\nproperty float u\nproperty float v\n"
      "element face {}\nproperty list uchar int vertex_index\nend_header\n",
      group.vertices.size(), group.vertices.size() / 3);
  // Of a vertex what `property` lines name: it begins with them.
  for (const scene::SurfaceVertex& vertex : group.vertices)
    bytes.append(reinterpret_cast<const char*>(&vertex), offsetof(scene::SurfaceVertex, color));
  for (std::uint32_t n = 0; n + 2 < group.vertices.size(); n += 3) {
    const std::uint32_t corners[3] = {n, n + 1, n + 2};
    bytes += '\3';
    bytes.append(reinterpret_cast<const char*>(corners), sizeof(corners));
  }
  return bytes;
}

/// All visible surfaces, from the first view's eye along the world's axes.
std::vector<Group> groups_of(const PeerScene& peer) {
  const Vec3 origin_m = instant::world_eye(peer.instant.views.front());
  std::map<std::tuple<std::uint32_t, float, float, float, bool>, Group> groups;
  const auto add = [&](const instant::PlacedMesh& placed) {
    const double distance_m = glm::length(placed.origin_m - origin_m);
    if (!placed.seen || distance_m < placed.visible_from_m || distance_m >= placed.visible_to_m) return;
    const scene::SurfaceMesh& mesh = peer.scene.meshes[placed.mesh];
    const glm::mat3 normals = glm::inverse(glm::transpose(placed.world_from_object));
    const glm::vec3 origin(placed.origin_m - origin_m);
    for (const scene::MeshPart& part : mesh.parts) {
      const scene::SurfaceMaterial& material = peer.scene.materials[part.material];
      const glm::vec3 paint = material.takes_paint ? glm::vec3(placed.tint) : glm::vec3(1.0f);
      const bool shines = placed.tint.w > 0.0f && material.emission != glm::vec3(0.0f);
      Group& group = groups[{part.material, paint.x, paint.y, paint.z, shines}];
      group.gloss = gloss_of(material, peer.instant.environment);
      group.color = material.base_color * paint * (1.0f - 0.55f * wetness(material, peer.instant.environment));
      group.image = shines ? material.maps[scene::SurfaceMap::emission] : material.base_color_image;
      if (shines) group.emission = material.emission * (placed.tint.w * peer.instant.emission_share);
      const std::uint32_t columns = material.picture_columns,
                          picture = placed.number % (columns * material.picture_rows);
      for (std::uint32_t n = part.first_index; n < part.first_index + part.index_count; ++n) {
        scene::SurfaceVertex vertex = mesh.vertices[mesh.indices[n]];
        vertex.position_m = origin + placed.world_from_object * vertex.position_m;
        vertex.normal = glm::normalize(normals * vertex.normal);
        vertex.uv =
            (vertex.uv + glm::vec2(picture % columns, picture / columns)) / glm::vec2(columns, material.picture_rows);
        group.vertices.push_back(vertex);
      }
    }
  };
  for (const scene::Instance& instance : peer.scene.instances) {
    const scene::SurfaceMesh& mesh = peer.scene.meshes[instance.mesh];
    add(instant::place(instance, {mesh.bounds_min_m, mesh.bounds_max_m}, instance.world_from_object));
  }
  for (const instant::PlacedMesh& part : peer.instant.parts) add(part);
  std::vector<Group> result;
  for (auto& [key, group] : groups)
    if (!group.vertices.empty()) result.push_back(std::move(group));
  for (const ice::IceBody& body : peer.instant.ice) {
    Group& group = result.emplace_back();
    group.ice = &body.look;
    for (const ice::IceVertex& vertex : body.vertices)
      group.vertices.push_back({glm::vec3(body.origin_m - origin_m) + vertex.position_m, vertex.normal, {}});
  }
  return result;
}

std::string numbers(const glm::vec3& v) { return fmt::format("[{}, {}, {}]", v.x, v.y, v.z); }

/// A group's entry in scene.json.
std::string told(const Group& group, const scene::ResolvedScene& scene) {
  if (group.ice)
    return fmt::format(
        "{{\"color\": [0, 0, 0], \"emission\": [0, 0, 0], \"image\": -1, \"srgb\": true, \"inside_index\": {}, "
        "\"outside_index\": {}, \"absorption_per_m\": {}}}",
        light::ice_index, light::air_index, numbers(group.ice->absorption_per_m));
  const bool srgb = group.image < 0 || scene.images[static_cast<std::size_t>(group.image)].srgb;
  std::string gloss = "null";
  if (group.gloss.share > 0.0f)
    gloss = fmt::format("{{\"share\": {}, \"alpha\": {}, \"f0\": {}, \"metallic\": {}}}", group.gloss.share,
                        group.gloss.alpha, group.gloss.f0, group.gloss.metallic);
  return fmt::format("{{\"color\": {}, \"emission\": {}, \"image\": {}, \"srgb\": {}, \"gloss\": {}}}",
                     numbers(group.color), numbers(group.emission), group.image, srgb, gloss);
}

/// Extinction and albedo in cells, as Septet's own cells have them: along each cell the light is weakened by its mean.
std::string write_smoke(const PeerScene& peer, const std::filesystem::path& folder) {
  if (peer.instant.smoke.empty()) return "null";
  const Smoke smoke(peer.instant.smoke, instant::world_eye(peer.instant.views.front()));
  const glm::vec3 middle(peer.instant.smoke[0].position_m - instant::world_eye(peer.instant.views.front()));
  const float half_m = 0.62f;  // Four deviations, and no wall.
  constexpr int cells = 96;
  std::string bytes = "VOL\3";
  const auto put = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof(value)); };
  for (const int word : {1, cells, cells, cells, 1}) put(word);
  for (const float sign : {-1.0f, 1.0f})
    for (int axis = 0; axis < 3; ++axis) put(middle[axis] + sign * half_m);
  const float step_m = 2.0f * half_m / cells;
  for (int z = 0; z < cells; ++z)
    for (int y = 0; y < cells; ++y)
      for (int x = 0; x < cells; ++x) {
        Ray ray;
        ray.origin_m = middle - half_m + step_m * (glm::vec3(x, y, z) + glm::vec3(0.0f, 0.5f, 0.5f));
        ray.direction = {1.0f, 0.0f, 0.0f};
        ray.to_m = step_m;
        put(smoke.optical_depth(ray) / step_m);
      }
  write(folder / "smoke.vol", bytes);
  return fmt::format("{{\"low_m\": {}, \"high_m\": {}, \"albedo\": {}}}", numbers(middle - half_m),
                     numbers(middle + half_m), numbers(peer.instant.smoke[0].albedo));
}

void run(std::string_view name, const std::filesystem::path& folder, std::uint32_t samples) {
  PeerScene peer = peer_scene(name);
  peer.settings.samples = samples;
  const instant::FrameView& view = peer.instant.views.front();
  const std::uint32_t width = view.viewport.width, height = view.viewport.height;
  auto tracer = RayTracer::create(peer.scene);
  if (!tracer) std::fprintf(stderr, "%s\n", describe(tracer.error()).c_str()), std::exit(1);
  tracer->begin(peer.instant, peer.settings);
  const std::clock_t began = std::clock();
  const TracedPicture picture = whole_picture(*tracer, width, height);
  const double processor_s = static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC;
  write_pfm(folder / "traced.pfm", width, height,
            [&](std::uint32_t x, std::uint32_t y) { return picture.at(x, y).radiance; });
  const std::size_t ice = peer.scene.instances.size() + peer.scene.meshes.size() + peer.scene.materials.size() + 1;
  write_pfm(folder / "ice.pfm", width, height,
            [&](std::uint32_t x, std::uint32_t y) { return glm::vec3(picture.at(x, y).object == ice ? 1.0f : 0.0f); });
  // Rows from the top, azimuth from +x towards +y.
  const instant::SkyLight& light = *peer.instant.light;
  write_pfm(folder / "sky.pfm", 2048, 1024, [&](std::uint32_t x, std::uint32_t y) {
    const double around = 2.0 * std::numbers::pi * (x + 0.5) / 2048.0, down = std::numbers::pi * (y + 0.5) / 1024.0;
    return instant::sky_radiance(light, glm::vec3(glm::dvec3(std::sin(down) * std::sin(around),
                                                             std::sin(down) * std::cos(around), std::cos(down))));
  });
  for (std::size_t n = 0; n < peer.scene.images.size(); ++n) {
    const scene::TextureImage& from = peer.scene.images[n];
    image::Image image(from.width, from.height);
    image.rgba = from.rgba;
    if (const auto done = image::write_png(folder / fmt::format("image{}.png", n), image, image::PngEffort::small);
        !done)
      std::fprintf(stderr, "%s\n", describe(done.error()).c_str()), std::exit(1);
  }
  std::string groups;
  const std::vector<Group> all = groups_of(peer);
  for (std::size_t n = 0; n < all.size(); ++n) {
    write(folder / fmt::format("mesh{}.ply", n), ply(all[n]));
    groups += (n ? ",\n  " : "") + told(all[n], peer.scene);
  }
  const Quat turn = view.world_from_car.orientation;
  const instant::OffAxisView& p = view.projection;
  write(folder / "scene.json",
        fmt::format(
            "{{\"width\": {}, \"height\": {}, \"processor_s\": {}, \"horizontal_deg\": {}, \"ahead\": {}, \"up\": {},\n"
            " \"longest\": {}, \"exposure\": {}, \"share_of_sky\": {}, \"sun_irradiance\": {}, \"to_sun\": {}, "
            "\"smoke\": {},\n"
            " \"groups\": [\n  {}]}}\n",
            width, height, processor_s, 2.0 * std::atan(p.right_slope) * 180.0 / std::numbers::pi,
            numbers(glm::vec3(turn * -p.back)), numbers(glm::vec3(turn * p.up)), peer.settings.paths.longest,
            peer.instant.exposure.scale(), peer.instant.share_of_sky, numbers(light.light_irradiance),
            numbers(light.light_direction), write_smoke(peer, folder), groups));
}

}  // namespace
}  // namespace septet::raytrace

int main(int count, char** arguments) {
  const unsigned long samples = count == 4 ? std::strtoul(arguments[3], nullptr, 10) : 0;
  if (!septet::raytrace::is_peer_scene(count == 4 ? arguments[1] : "") || samples < 1 || samples > 1000000)
    return std::fputs("septet-peer-scene noon|night|tunnel|smoke|gloss|ice FOLDER SAMPLES\n", stderr), 2;
  septet::raytrace::run(arguments[1], arguments[2], static_cast<std::uint32_t>(samples));
}
